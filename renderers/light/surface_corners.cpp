#include "renderers/light/surface_corners.h"

#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace fenestra {
namespace {

using glm::vec3;

// Corners are moved this part of the way into their faces: on the edge itself, a ray into the
// neighbouring solid would start on that solid's surface and might miss it.
constexpr float kInwards = 0.02f;

}  // namespace

BakePoint SharedCorner::Side(bool front) const {
  const vec3 centroid = centroid_sum_W / count;
  return {p_W + kInwards * (centroid - p_W), front ? n_W : -n_W};
}

SharedCorners FindSharedCorners(const TriangleSoup& soup, const std::vector<uint32_t>& surfaces) {
  SharedCorners shared;
  std::map<std::pair<uint32_t, uint32_t>, size_t> index;
  for (size_t t = 0; t < soup.size(); ++t) {
    std::array<size_t, 3> ids{};
    vec3 centroid(0.0f);
    for (int k = 0; k < 3; ++k) centroid += soup.positions_W[soup.triangles[t][k]] / 3.0f;
    const bool smooth = soup.is_smooth(t);
    for (int k = 0; k < 3; ++k) {
      const uint32_t vertex = soup.triangles[t][k];
      const auto [entry, is_new] = index.try_emplace({vertex, surfaces[t]}, shared.corners.size());
      if (is_new) {
        vec3 n = soup.normals_W[t];
        if (smooth) {
          const vec3& shading = soup.vertex_normals_W[vertex];
          n = glm::dot(n, shading) < 0.0f ? -shading : shading;
        }
        shared.corners.push_back({.p_W = soup.positions_W[vertex],
                                  .n_W = n,
                                  .surface = surfaces[t],
                                  .is_closed = soup.is_closed[t],
                                  .is_smooth = smooth});
      }
      SharedCorner& corner = shared.corners[entry->second];
      corner.centroid_sum_W += centroid;
      corner.count += 1.0f;
      ids[static_cast<size_t>(k)] = entry->second;
    }
    shared.of_triangle.push_back(ids);
  }
  return shared;
}

}  // namespace fenestra
