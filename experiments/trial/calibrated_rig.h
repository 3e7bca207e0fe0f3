#pragma once

#include <optional>

#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "experiments/study/calibration_choice.h"
#include "experiments/trial/calibration_cache.h"
#include "sim/stereo/stereo_rig.h"

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

}  // namespace fenestra
