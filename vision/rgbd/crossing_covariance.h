#pragma once

#include <Eigen/Core>

#include "vision/rgbd/diagonals.h"
#include "vision/rgbd/dominant_plane.h"

namespace fenestra {

/// How four key points err as vertices.
struct VertexErrors {
  /// Standard deviation in the plane, in each direction, to be expected before a frame is seen.
  double expected_m;
  /// What that is worth, as if it had been found from so many residuals.
  double expected_weight;
  double across_m;  ///< Standard deviation of a key point across the plane: the cloud's scatter.
  /// Standard deviation of what all of the cloud is off by across the plane: depth comes in steps,
  /// and a wall that is faced squarely lies on one.
  double common_m;
};

/// Covariance [m²] of where the diagonals of four vertices cross.
///
/// The midpoint of each diagonal is off by the mean of its two vertices' errors, and the crossing
/// takes from each the part across it; for diagonals at right angles the variance in the plane is
///
///     σ² / 2  in each direction,      across the plane  σ_a² / 4 + σ_c².
///
/// σ comes from the vertices themselves as well as from what is expected: a rectangle has
/// V0 − V1 + V2 − V3 = 0 (two residuals in the plane) and diagonals of one length (a third), each
/// with variance 4 σ²:
///
///     σ² = (w σ_e² + Σ r² / 4) / (w + 3),    w and σ_e the expected weight and deviation.
///
/// A window that is no rectangle makes it too large, never too small.
Eigen::Matrix3d CrossingCovariance(const FourVertices& p_KV, const Plane& plane,
                                   const VertexErrors& errors);

}  // namespace fenestra
