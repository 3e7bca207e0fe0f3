#pragma once

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"

namespace fenestra {

/// Throws InputError with all faults if the image sizes or the depth unit are not those of the
/// calibration.
void CheckFits(const RgbdObservation& observation, const RgbdCalibration& calibration);

}  // namespace fenestra
