#pragma once

#include <optional>

#include "experiments/study/calibration_choice.h"
#include "sim/stereo/stereo_rig.h"
#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// Covariance of the error of this rig's nominal calibration (PairError), to first order, under the
/// distribution that the choice draws from. nullopt: the calibration is exact. `boards`: the
/// covariance that a calibration with boards estimates for itself; it must be there for kBoards and
/// kStale.
std::optional<PairMatrix> CalibrationCovariance(const StereoRig& rig, const CalibrationChoice& choice,
                                         const std::optional<PairMatrix>& boards);

}  // namespace fenestra
