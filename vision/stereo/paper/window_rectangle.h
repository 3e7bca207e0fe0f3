#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/detection/detection.h"
#include "vision/frame/detection/quadrilateral.h"
#include "vision/stereo/paper/disparity_plane.h"
#include "vision/stereo/paper/matched_patch.h"

namespace fenestra {

/// Computes the window in the frame F of the rectified left camera. Each corner is the point where
/// the ray of its pixel meets the window's plane, and the centroid is the intersection of the
/// diagonals. (For a rectangle this is the centre, and unlike the mean of the corners it is
/// invariant under perspective.) Returns nullopt if a corner's ray does not meet the plane in front
/// of the camera.
std::optional<WindowEstimate> WindowOnPlane(const Quadrilateral& corners_px,
                                            const DisparityPlane& plane,
                                            const RectifiedCamera& camera);

/// Transforms an estimate from frame F to frame C, which is rotated by R_CF.
WindowEstimate Rotated(const Eigen::Matrix3d& R_CF, const WindowEstimate& estimate_F);

/// Errors of block matching that the residuals of a plane do not show.
struct MatchErrors {
  double window_px;         ///< Side of the SAD block; matches within a block have common errors.
  double subpixel_bias_px;  ///< Standard deviation of the error that a whole side shares.
  double contour_px;        ///< Standard deviation of a contour's side, perpendicular to it.
};

/// Variance [px²] at `pixel` of the disparity of the plane fitted to the patches.
///
/// The fitted value is Σ wᵢ dᵢ with wᵢ = rᵢᵀ (Σ rᵣᵀ)⁻¹ r(pixel), r = (u, v, 1), over the matches
/// within `tolerance_px` of the plane. Their errors have two parts:
///
///     scatter   s² Σ wᵢ² · N / N',   s² = Σ residual² / (N − 3),
///               N' = Σ over patches of area / window²: matches whose blocks overlap have common
///               errors;
///     bias      σ_b² Σ over patches of (Σ wᵢ in the patch)²: a vertical edge has one phase against
///               the pixels along all its length, and a parabola through SAD sums errs with it.
///
/// Returns nullopt if fewer than four matches are on the plane or if they do not determine a plane.
std::optional<double> DisparityVariance(const std::vector<const MatchedPatch*>& patches,
                                        const DisparityPlane& plane, double tolerance_px,
                                        const Eigen::Vector2d& pixel, const MatchErrors& errors);

/// Covariance [m²], in F, of the point on `plane` at `pixel`, the centre of a contour. Each of the
/// contour's four sides has the standard deviation `errors.contour_px`, so the centre between two
/// has that over √2. First-order propagation of z = f B / d and p = z (x, y, 1). Domain: d(pixel) >
/// 0.
Eigen::Matrix3d CentreCovariance(const Eigen::Vector2d& pixel, const DisparityPlane& plane,
                                 double disparity_variance_px2, const RectifiedCamera& camera,
                                 const MatchErrors& errors);

}  // namespace fenestra
