#pragma once

#include <cstddef>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/placement.h"

namespace fenestra::gltf {

/// Bytes of memory that a scene takes from reading to rendering: for each triangle with vertices of
/// its own, each pixel of a texture with its smaller levels, and each mesh. Measured: see
/// docs/gltf.md.
inline constexpr size_t kBytesPerTriangle = 1700;
inline constexpr size_t kBytesPerTexel = 24;
inline constexpr size_t kBytesPerMesh = 1500;

/// The bytes that remain for textures. Throws InputError if the nodes' meshes would need more than
/// `options.max_memory_bytes`, and says how much, or if they have more triangles than
/// `options.max_triangles`; nothing is read for it but the sizes that the file claims.
size_t CheckCost(const Asset& asset, const std::vector<PlacedNode>& nodes,
                 const GltfReadOptions& options);

}  // namespace fenestra::gltf
