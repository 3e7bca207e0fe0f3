#pragma once

#include <optional>

#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "experiments/study/trial_settings.h"
#include "experiments/trial/calibration_cache.h"
#include "sim/stereo/stereo_rig.h"
#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// A rig as it flies, and its nominal calibration, which detectors are given.
struct CalibratedRig {
  StereoRig rig;
  StereoCalibration nominal;
  /// Of the nominal calibration's error: see CalibrationCovariance. nullopt: there is no error.
  std::optional<PairMatrix> covariance;
};

/// Calibrates a rig that was just built. A pure function of all but the cache, which only saves
/// time. Throws InputError if a calibration with boards fails.
CalibratedRig Calibrated(const StereoRig& rig, const CalibrationChoice& choice,
                         const RandomStream& calibration, const CalibrationCache& cache);

/// Covariance of the error of this rig's nominal calibration (PairError), to first order, under the
/// distribution that the choice draws from. nullopt: the calibration is exact. `boards`: the
/// covariance that a calibration with boards estimates for itself; it must be there for kBoards and
/// kStale.
std::optional<PairMatrix> CalibrationCovariance(const StereoRig& rig,
                                                const CalibrationChoice& choice,
                                                const std::optional<PairMatrix>& boards);

}  // namespace fenestra
