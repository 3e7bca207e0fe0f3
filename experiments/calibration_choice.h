#pragma once

#include "core/calibration.h"
#include "core/random_stream.h"
#include "sim/stereo_rig.h"

namespace fenestra {

/// Where a detector's knowledge of its stereo rig comes from.
enum class CalibrationSource {
  kExact,      ///< The true rig.
  kPerturbed,  ///< The true rig with a random error of the right camera's pose.
  kDesign,     ///< The rig as designed: never calibrated.
};

struct CalibrationChoice {
  CalibrationSource source = CalibrationSource::kPerturbed;
  /// kPerturbed: standard deviations about and along each axis. The size of a good calibration's
  /// error.
  double rotation_error_rad = 1e-4;
  double translation_error_m = 1e-4;
};

/// What a detector is told of the rig. A pure function of its arguments.
StereoCalibration CalibrationOf(const StereoRig& rig, const CalibrationChoice& choice,
                                const RandomStream& calibration);

}  // namespace fenestra
