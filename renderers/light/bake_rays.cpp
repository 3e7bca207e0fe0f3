#include "renderers/light/bake_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

namespace fenestra {
namespace {

using glm::vec3;

// Corners are moved this part of the way into their faces: on the edge itself, a ray into the
// neighbouring solid would start on that solid's surface and might miss it.
constexpr float kInwards = 0.02f;

// Cosine-weighted directions about +z from uniform (a, b) in (-1, 1)²: Malley's method with the
// concentric map from square to disc, which keeps cells compact. Source: P. Shirley and K. Chiu,
// "A low distortion map between disk and square", 1997.
vec3 CosineDirection(float a, float b) {
  constexpr float kQuarterPi = std::numbers::pi_v<float> / 4.0f;
  const bool a_is_radius = std::abs(a) > std::abs(b);
  const float r = a_is_radius ? a : b;
  const float ratio = r == 0.0f ? 0.0f : (a_is_radius ? b : a) / r;
  const float phi = a_is_radius ? kQuarterPi * ratio : kQuarterPi * (2.0f - ratio);
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(1.0f - r * r, 0.0f))};
}

// The centres of a 4 x 4 grid of squares of size `step`.
DirectionSquare MakeSquare(float a, float b, float step) {
  DirectionSquare square;
  for (int i = 0; i < kLanes; ++i) {
    const int row = i / kDirectionSquare;
    const int column = i % kDirectionSquare;
    square[static_cast<size_t>(i)] =
        CosineDirection(a + (static_cast<float>(row) + 0.5f) * step,
                        b + (static_cast<float>(column) + 0.5f) * step);
  }
  return square;
}

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

HemisphereDirections MakeHemisphereDirections() {
  constexpr float kStep = 2.0f / kHemisphereCells;
  HemisphereDirections table;
  for (int row = 0; row < kHemisphereCells; ++row) {
    for (int column = 0; column < kHemisphereCells; ++column) {
      const float a = -1.0f + static_cast<float>(row) * kStep;
      const float b = -1.0f + static_cast<float>(column) * kStep;
      table.cells.push_back(MakeSquare(a, b, kStep / kDirectionSquare));
      if (row % kDirectionSquare == 0 && column % kDirectionSquare == 0) {
        table.tiles.push_back(MakeSquare(a, b, kStep));
      }
    }
  }
  return table;
}

}  // namespace fenestra
