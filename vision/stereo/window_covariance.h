#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/stereo/matched_patch.h"

namespace fenestra {

/// How block matching errs, beyond what the residuals of a plane show.
struct MatchErrors {
  double window_px;         ///< Side of the SAD window, within which matches err alike.
  double subpixel_bias_px;  ///< Standard deviation of what a whole side is off by.
  double contour_px;        ///< Standard deviation of a contour's side across itself.
};

/// Variance [px²] of the disparity that the plane fitted to these patches has at `pixel`.
///
/// The fitted value is Σ wᵢ dᵢ with wᵢ = rᵢᵀ (Σ rᵣᵀ)⁻¹ r(pixel), r = (u, v, 1), over the matches
/// within `tolerance_px` of the plane. Their errors have two parts:
///
///     scatter   s² Σ wᵢ² · N / N',   s² = Σ residual² / (N − 3),
///               N' = Σ over patches of area / window²: matches whose windows overlap err alike;
///     bias      σ_b² Σ over patches of (Σ wᵢ in the patch)²: an upright edge has one phase against
///               the pixels along all its length, and a parabola through SAD sums errs with it.
///
/// nullopt if fewer than four matches are on the plane or if they fix none.
std::optional<double> DisparityVariance(const std::vector<const MatchedPatch*>& patches,
                                        const DisparityPlane& plane, double tolerance_px,
                                        const Eigen::Vector2d& pixel, const MatchErrors& errors);

/// Covariance [m²], in F, of the point of `plane` at `pixel`, the centre of a contour whose four
/// sides are each off by `errors.contour_px`: the centre between two is off by that over √2. With
/// z = f B / d and p = z (x, y, 1), by first-order propagation. Domain: d(pixel) > 0.
Eigen::Matrix3d CentreCovariance(const Eigen::Vector2d& pixel, const DisparityPlane& plane,
                                 double disparity_variance_px2, const RectifiedCamera& camera,
                                 const MatchErrors& errors);

}  // namespace fenestra
