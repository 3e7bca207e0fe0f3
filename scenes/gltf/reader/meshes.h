#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/materials.h"
#include "scenes/gltf/reader/placement.h"
#include "scenes/gltf/reader/surfaces.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

/// A surface transformed into the world by M_WM or, if it is skinned, each vertex by a transform of
/// its own. The caller sets name, material and `closed` of the mesh. If one normal has no
/// direction, the mesh has no normals at all.
Mesh CarryToWorld(const Surface& surface, const Eigen::Matrix4d& M_WM);
Mesh CarryToWorld(const Surface& surface, const std::vector<Eigen::Matrix4d>& M_WM_of_vertex);

/// The visible triangles of all placed nodes, in their order, one mesh per primitive. `material`
/// indexes the document's materials, and is their number where a primitive has none.
/// `first_mesh[i]` is the first mesh of placed node i or a later one; it has one more element.
struct PlacedMeshes {
  std::vector<Mesh> meshes;
  std::vector<size_t> first_mesh;
};

PlacedMeshes PlaceMeshes(const Asset& asset, const std::vector<PlacedNode>& nodes,
                         const std::vector<ReadMaterial>& materials, Notes& notes);

}  // namespace fenestra::gltf
