#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "renderers/tracing/packet.h"
#include "renderers/tracing/triangle_soup.h"

namespace fenestra {

/// A point with the normal of the hemisphere that is seen from it.
struct BakePoint {
  glm::vec3 p_W{0.0f};
  glm::vec3 n_W{0.0f};
};

/// For each point the index of the one whose light it shares: its own, or if there are more than
/// `most`, the first one of those in the same cell of a grid that face alike. There are at most
/// `most` of these, but at least one for each of a few dozen directions, and the cells are as small
/// as that allows.
std::vector<size_t> SharedPoints(const std::vector<BakePoint>& points, size_t most);

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
  std::vector<DirectionSquare> tiles;     ///< The centres of 4 x 4 cells each; row-major.
  DirectionSquare whole{};                ///< Sixteen all over the hemisphere.
  std::vector<DirectionSquare> cells;     ///< Sixteen directions inside each cell; row-major.
  std::vector<DirectionSquare> quarters;  ///< Sixteen inside each quarter of each cell.

  std::span<const DirectionSquare, 4> QuartersOf(size_t cell) const {
    return std::span<const DirectionSquare, 4>(quarters.data() + 4 * cell, 4);
  }
};

HemisphereDirections MakeHemisphereDirections();

}  // namespace fenestra
