#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "vision/rgbd/paper/cloud_shape.h"

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

/// Errors of four key points when they are used as vertices.
struct VertexErrors {
  /// Standard deviation in the plane, in each direction, that is expected before a frame is seen.
  double expected_m;
  /// Weight of that expectation, as the equivalent number of residuals.
  double expected_weight;
  double across_m;  ///< Standard deviation of a key point across the plane: the cloud's scatter.
  /// Standard deviation of an error across the plane that the whole cloud shares: depth is
  /// quantised, and a wall seen head-on lies within one step.
  double common_m;
};

/// Covariance [m²] of the point where the diagonals of four vertices cross.
///
/// The midpoint of each diagonal is off by the mean of its two vertices' errors, and the crossing
/// takes from each diagonal the component perpendicular to it. For diagonals at right angles the
/// variances are
///
///     σ² / 2  in each direction,      across the plane  σ_a² / 4 + σ_c².
///
/// σ combines the residuals of the vertices themselves with the expectation. A rectangle has V0 −
/// V1 + V2 − V3 = 0 (two residuals in the plane) and diagonals of equal length (a third residual),
/// each with variance 4 σ²:
///
///     σ² = (w σ_e² + Σ r² / 4) / (w + 3),    w and σ_e the expected weight and deviation.
///
/// For a window that is not a rectangle, σ is too large, never too small.
Eigen::Matrix3d CrossingCovariance(const FourVertices& p_KV, const Plane& plane,
                                   const VertexErrors& errors);

}  // namespace fenestra
