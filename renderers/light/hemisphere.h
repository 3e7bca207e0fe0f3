#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "renderers/tracing/packet.h"

namespace fenestra {

/// The hemisphere about +z is divided into kHemisphereCells x kHemisphereCells compact cells of
/// equal cosine-weighted solid angle.
inline constexpr int kHemisphereCells = 24;

/// Rays of a packet form a square of cells, or of parts of one cell.
inline constexpr int kDirectionSquare = 4;
static_assert(kDirectionSquare * kDirectionSquare == kLanes);
static_assert(kHemisphereCells % kDirectionSquare == 0);

/// Sixteen unit directions, row-major.
using DirectionSquare = std::array<glm::vec3, kLanes>;

struct HemisphereDirections {
  std::vector<DirectionSquare> tiles;  ///< The centres of 4 x 4 cells each; row-major.
  std::vector<DirectionSquare> cells;  ///< Sixteen directions inside each cell; row-major.
};

HemisphereDirections MakeHemisphereDirections();

}  // namespace fenestra
