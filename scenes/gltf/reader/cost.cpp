#include "scenes/gltf/reader/cost.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/input_error.h"
#include "scenes/gltf/reader/surfaces.h"
#include "scenes/gltf/tinygltf.h"
#include "scenes/gltf/validation/extensions.h"

namespace fenestra::gltf {
namespace {

// Three vertices make a triangle; those that no triangle uses take memory all the same.
double BytesOf(double triangles, double vertices, double meshes) {
  return static_cast<double>(kBytesPerTriangle) * std::max(triangles, vertices / 3.0) +
         static_cast<double>(kBytesPerMesh) * meshes;
}

}  // namespace

size_t CheckCost(const Asset& asset, const std::vector<PlacedNode>& nodes,
                 const GltfReadOptions& options) {
  // As doubles, which products of what a file claims do not overflow.
  double triangles = 0.0;
  double vertices = 0.0;
  double meshes = 0.0;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = asset.model.nodes[placed.node];
    if (!placed.is_visible || node.mesh < 0) continue;
    const auto instances = static_cast<double>(InstanceCount(asset.model, node));
    for (const auto& primitive : asset.model.meshes[static_cast<size_t>(node.mesh)].primitives) {
      if (!IsSurface(primitive)) continue;
      triangles += instances * static_cast<double>(ClaimedTriangles(asset, primitive));
      vertices += instances * static_cast<double>(ClaimedVertices(asset, primitive));
      meshes += instances;
    }
  }
  const auto limit = static_cast<double>(options.max_memory_bytes);
  const double needed = BytesOf(triangles, vertices, meshes);
  if (needed > limit) {
    throw InputError(asset.file,
                     fmt::format("its {:.0f} triangles and {:.0f} vertices in {:.0f} "
                                 "meshes would need about {:.2g} GB of memory; the "
                                 "limit is {:.2g} GB (--memory-gb)",
                                 triangles, vertices, meshes, needed / 1e9, limit / 1e9));
  }
  if (triangles > static_cast<double>(options.max_triangles)) {
    throw InputError(asset.file, fmt::format("it has {:.0f} triangles, more than {} triangles",
                                             triangles, options.max_triangles));
  }
  return static_cast<size_t>(limit - needed);
}

}  // namespace fenestra::gltf
