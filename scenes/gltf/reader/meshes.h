#pragma once

#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/materials.h"
#include "scenes/gltf/reader/placement.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

/// The visible triangles of all placed nodes, in their order, one mesh per primitive. `material`
/// indexes the document's materials, and is their number where a primitive has none.
/// `first_mesh[i]` is the first mesh of placed node i or a later one; it has one more element.
struct PlacedMeshes {
  std::vector<Mesh> meshes;
  std::vector<size_t> first_mesh;
};

/// Throws InputError beyond `max_triangles`, before any of them is read.
PlacedMeshes PlaceMeshes(const Asset& asset, const std::vector<PlacedNode>& nodes,
                         const std::vector<ReadMaterial>& materials, size_t max_triangles,
                         Notes& notes);

}  // namespace fenestra::gltf
