#pragma once

#include <optional>

#include "experiments/study/calibration_choice.h"
#include "sim/stereo/stereo_rig.h"
#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// How far what detectors are told of this rig may be from the truth, to first order: the
/// covariance of PairError, by the law that the choice draws from. nullopt: it is the truth.
/// `boards`: the covariance that a calibration with boards states of itself; it must be there for
/// kBoards and kStale.
std::optional<PairMatrix> CalibrationLaw(const StereoRig& rig, const CalibrationChoice& choice,
                                         const std::optional<PairMatrix>& boards);

}  // namespace fenestra
