#pragma once

#include <vector>

#include "vision/frame/step_fit.h"

namespace fenestra {

/// What is known of a side besides its pixels.
struct SideFacts {
  double excess;   ///< Residuals' mean square for the weights as they are.
  double falloff;  ///< Relative change of the light across the edge by vignetting, outwards [1/px].
};

struct Learnt {
  EdgeTuning tuning;
  /// By how much all of the side's edges may be off together because of what is not known of the
  /// tuning: its covariance, by the mean of the strips' derivatives.
  double common_sigma_px = 0.0;
};

/// The tuning that these fits of a side's strips suggest: a step of Gauss and Newton for blur and
/// slopes, with the strips' own unknowns eliminated, the mean step, and the residuals' variances on
/// either side. Slopes are expected to be those of vignetting, in proportion to the light on their
/// side of the edge, give or take some hundredths of a per cent a pixel; a law with long tails, so
/// that where shading makes other ones, these are believed.
Learnt Learn(const StepModel& model, const std::vector<EdgeStrip>& strips,
             const std::vector<StepFit>& fits, const SideFacts& facts, const SideRequest& request,
             const EdgeTuning& tuning);

}  // namespace fenestra
