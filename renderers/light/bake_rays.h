#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "renderers/tracing/packet.h"
#include "renderers/tracing/triangle_soup.h"

namespace fenestra {

/// A point with the normal of the hemisphere that is seen from it.
struct BakePoint {
  glm::vec3 p_W{0.0f};
  glm::vec3 n_W{0.0f};
};

/// A vertex of one surface: the corners of all its triangles there share their view.
struct SharedCorner {
  glm::vec3 p_W{0.0f};
  glm::vec3 n_W{0.0f};
  glm::vec3 centroid_sum_W{0.0f};  ///< Over the triangles of the surface that meet here,
  float count = 0.0f;              ///< of which there are this many.
  uint32_t surface = 0;            ///< See NumberSurfaces.
  bool is_closed = false;          ///< See Mesh::closed.
  bool is_smooth = false;          ///< n_W is the vertex's normal instead of the triangles'.

  /// A point on one side, a little inside the surface.
  BakePoint Side(bool front) const;
};

/// All of them, and for each triangle the indices of its three.
struct SharedCorners {
  std::vector<SharedCorner> corners;
  std::vector<std::array<size_t, 3>> of_triangle;
};

SharedCorners FindSharedCorners(const TriangleSoup& soup, const std::vector<uint32_t>& surfaces);

/// The same triangles with at most `most` corners (but at least one for each of a few dozen
/// directions): those that are in one cell of a grid and face alike become one, the first of them.
/// The cells are as small as that allows; corners that are few enough stay as they are.
SharedCorners Thinned(SharedCorners shared, size_t most);

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
  DirectionSquare whole{};             ///< Sixteen all over the hemisphere.
  std::vector<DirectionSquare> cells;  ///< Sixteen directions inside each cell; row-major.
};

HemisphereDirections MakeHemisphereDirections();

}  // namespace fenestra
