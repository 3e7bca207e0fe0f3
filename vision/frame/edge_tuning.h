#pragma once

#include <vector>

#include "vision/frame/step_fit.h"

namespace fenestra {

struct Learnt {
  EdgeTuning tuning;
  /// By how much all of the side's edges may be off together because of what is not known of the
  /// tuning: its covariance, by the mean of the strips' derivatives.
  double common_sigma_px = 0.0;
};

/// The tuning that these fits of a side's strips suggest: a step of Gauss and Newton for blur and
/// slopes, with the strips' own unknowns eliminated, the mean step, and the residuals' variances on
/// either side. `excess`: the residuals' mean square for the weights as they are.
Learnt Learn(const StepModel& model, const std::vector<EdgeStrip>& strips,
             const std::vector<StepFit>& fits, double excess, const SideRequest& request,
             const EdgeTuning& tuning);

}  // namespace fenestra
