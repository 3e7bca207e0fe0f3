#include "renderers/light/bake_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
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

namespace {

// The index of each corner among the cells of this size, in the order of their first corners;
// nothing if there are more than `most` cells.
std::optional<std::vector<size_t>> CellsOf(const std::vector<SharedCorner>& corners, double size_m,
                                           size_t most) {
  // Wide enough for neighbours on a curved surface, and for no two faces of a box.
  constexpr float kDirectionStep = 1.0f / 1.5f;
  std::map<std::array<int64_t, 7>, size_t> cells;
  std::vector<size_t> cell_of;
  for (const SharedCorner& corner : corners) {
    std::array<int64_t, 7> key{};
    for (size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<glm::length_t>(k);
      key[k] = static_cast<int64_t>(std::floor(static_cast<double>(corner.p_W[axis]) / size_m));
      key[k + 3] = std::lround(corner.n_W[axis] / kDirectionStep);
    }
    key[6] = corner.is_closed ? 1 : 0;
    cell_of.push_back(cells.try_emplace(key, cells.size()).first->second);
    if (cells.size() > most) return std::nullopt;
  }
  return cell_of;
}

}  // namespace

SharedCorners Thinned(SharedCorners shared, size_t most) {
  if (shared.corners.size() <= most) return shared;
  vec3 low(std::numeric_limits<float>::max());
  vec3 high(std::numeric_limits<float>::lowest());
  for (const SharedCorner& corner : shared.corners) {
    low = glm::min(low, corner.p_W);
    high = glm::max(high, corner.p_W);
  }
  // From a grid that is finer than any that is wanted to one with a cell on each side of the
  // origin, where directions alone differ.
  constexpr int kFinest = -20;
  const double extent_m =
      std::max(glm::length(glm::dvec3(high)) + glm::length(glm::dvec3(low)), 1e-30);
  std::optional<std::vector<size_t>> cell_of;
  for (int k = kFinest; !cell_of && k <= 0; ++k) {
    cell_of = CellsOf(shared.corners, std::ldexp(extent_m, k), k < 0 ? most : SIZE_MAX);
  }
  SharedCorners thinned;
  for (size_t i = 0; i < shared.corners.size(); ++i) {
    if ((*cell_of)[i] == thinned.corners.size()) thinned.corners.push_back(shared.corners[i]);
  }
  for (std::array<size_t, 3> ids : shared.of_triangle) {
    for (size_t& id : ids) id = (*cell_of)[id];
    thinned.of_triangle.push_back(ids);
  }
  return thinned;
}

HemisphereDirections MakeHemisphereDirections() {
  constexpr float kStep = 2.0f / kHemisphereCells;
  HemisphereDirections table;
  table.whole = MakeSquare(-1.0f, -1.0f, 2.0f / kDirectionSquare);
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
