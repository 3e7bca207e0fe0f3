#include "renderers/light/hemisphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    square[static_cast<size_t>(i)] =
        CosineDirection(a + (static_cast<float>(i / kDirectionSquare) + 0.5f) * step,
                        b + (static_cast<float>(i % kDirectionSquare) + 0.5f) * step);
  }
  return square;
}

}  // namespace

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
