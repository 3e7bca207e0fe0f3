#include "renderers/light/bake_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "renderers/tracing/sobol_samples.h"

namespace fenestra {
namespace {

using glm::vec3;

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

namespace {

// The first point in the cell of each; nothing if there are more than `most` cells.
std::optional<std::vector<size_t>> FirstInCells(const std::vector<BakePoint>& points, double size_m,
                                                size_t most) {
  // Wide enough for neighbours on a curved surface, and for no two faces of a box.
  constexpr float kDirectionStep = 1.0f / 1.5f;
  std::map<std::array<int64_t, 6>, size_t> cells;
  std::vector<size_t> first;
  for (size_t i = 0; i < points.size(); ++i) {
    std::array<int64_t, 6> key{};
    for (size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<glm::length_t>(k);
      key[k] = static_cast<int64_t>(std::floor(static_cast<double>(points[i].p_W[axis]) / size_m));
      key[k + 3] = std::lround(points[i].n_W[axis] / kDirectionStep);
    }
    first.push_back(cells.try_emplace(key, i).first->second);
    if (cells.size() > most) return std::nullopt;
  }
  return first;
}

}  // namespace

std::vector<size_t> SharedPoints(const std::vector<BakePoint>& points, size_t most) {
  if (points.size() <= most) {
    std::vector<size_t> own(points.size());
    std::iota(own.begin(), own.end(), size_t{0});
    return own;
  }
  vec3 low(std::numeric_limits<float>::max());
  vec3 high(std::numeric_limits<float>::lowest());
  for (const BakePoint& point : points) {
    low = glm::min(low, point.p_W);
    high = glm::max(high, point.p_W);
  }
  // From a grid that is finer than any that is wanted to one with a cell on each side of the
  // origin, where directions alone differ.
  constexpr int kFinest = -20;
  const double extent_m =
      std::max(glm::length(glm::dvec3(high)) + glm::length(glm::dvec3(low)), 1e-30);
  std::optional<std::vector<size_t>> shared;
  for (int k = kFinest; !shared && k <= 0; ++k) {
    shared = FirstInCells(points, std::ldexp(extent_m, k), k < 0 ? most : SIZE_MAX);
  }
  return *shared;
}

namespace {

// Sixteen points of a square of size `step` that are stratified along both sides, so that an edge
// along one of them is found to a sixteenth of the square; squares differ in them.
DirectionSquare MakeNet(float a, float b, float step, uint32_t square) {
  const uint32_t scramble_x = 0x9e3779b1u * (square + 1);
  const uint32_t scramble_y = 0x85ebca6bu * (square + 1);
  DirectionSquare net;
  for (uint32_t i = 0; i < kLanes; ++i) {
    const SobolPoint p = NthSobolPoint(i);
    net[i] =
        CosineDirection(a + ToUnit(p.x ^ scramble_x) * step, b + ToUnit(p.y ^ scramble_y) * step);
  }
  return net;
}

}  // namespace

HemisphereDirections MakeHemisphereDirections() {
  constexpr float kStep = 2.0f / kHemisphereCells;
  HemisphereDirections table;
  table.whole = MakeSquare(-1.0f, -1.0f, 2.0f / kDirectionSquare);
  for (int row = 0; row < kHemisphereCells; ++row) {
    for (int column = 0; column < kHemisphereCells; ++column) {
      const float a = -1.0f + static_cast<float>(row) * kStep;
      const float b = -1.0f + static_cast<float>(column) * kStep;
      table.cells.push_back(MakeNet(a, b, kStep, static_cast<uint32_t>(table.cells.size())));
      for (const auto& [x, y] : {std::pair(0.0f, 0.0f), {0.0f, 0.5f}, {0.5f, 0.0f}, {0.5f, 0.5f}}) {
        table.quarters.push_back(MakeNet(a + x * kStep, b + y * kStep, 0.5f * kStep,
                                         static_cast<uint32_t>(table.quarters.size())));
      }
      if (row % kDirectionSquare == 0 && column % kDirectionSquare == 0) {
        table.tiles.push_back(MakeSquare(a, b, kStep));
      }
    }
  }
  return table;
}

}  // namespace fenestra
