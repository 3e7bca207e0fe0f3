#pragma once

#include <vector>

#include "vision/frame/measurement/step_fit.h"

namespace fenestra {

/// What is known about a side apart from its pixels.
struct SideFacts {
  double excess;   ///< Mean square of the residuals for the weights as they are.
  double falloff;  ///< Relative change of the light across the edge by vignetting, outwards [1/px].
};

struct NuisanceEstimate {
  EdgeNuisance nuisance;
  /// Standard deviation of the error that all edge points of the side share because the nuisance
  /// parameters are uncertain: their covariance, propagated by the mean of the strips' derivatives.
  double common_sigma_px = 0.0;
};

/// Estimates the nuisance parameters from the fits of a side's strips: a Gauss–Newton step for blur
/// and slopes with the strips' own unknowns eliminated, the mean step, and the variances of the
/// residuals on either side. The prior expects the slopes of vignetting, in proportion to the light
/// on their side of the edge, give or take some hundredths of a per cent per pixel. Its tails are
/// long, so that other slopes are accepted where shading causes them.
NuisanceEstimate EstimateNuisance(const StepModel& model, const std::vector<EdgeStrip>& strips,
                                  const std::vector<StepFit>& fits, const SideFacts& facts,
                                  const SideRequest& request, const EdgeNuisance& nuisance);

}  // namespace fenestra
