#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace fenestra {

/// Four vertices in the order in which an outline visits them.
using FourVertices = std::array<Eigen::Vector3d, 4>;

struct DiagonalCrossing {
  Eigen::Vector3d p_CO;  ///< Midpoint of the shortest segment between the diagonals.
  double gap_m = 0.0;    ///< Length of that segment; 0 for a planar quadrilateral.
};

/// Where the diagonals V0 V2 and V1 V3 of a quadrilateral cross. In space they need not meet, so
/// the midpoint of the shortest segment between their lines is taken: with points a + s u and
/// b + t v, the s and t that minimise |(a + s u) − (b + t v)|²,
///
///     w = a − b,   D = (u·u)(v·v) − (u·v)²
///     s = ((u·v)(v·w) − (v·v)(u·w)) / D,   t = ((u·u)(v·w) − (u·v)(u·w)) / D.
///
/// For a parallelogram this is the centre, also when it is seen in perspective, since the vertices
/// are points in space. Returns nullopt if a diagonal vanishes, if the diagonals are parallel to
/// within 1e-6 rad, or if they cross outside one of them (the outline is then not convex).
std::optional<DiagonalCrossing> CrossDiagonals(const FourVertices& p_CV);

}  // namespace fenestra
