#pragma once

#include <string>

#include "experiments/study/trial_settings.h"
#include "sim/stereo/board_session.h"
#include "vision/calibration/stereo_calibration.h"

namespace fenestra {

/// Calibrates a simulated rig as a real one is: pictures of a board through its own optics and
/// noise (sim/stereo/board_session), corners, adjustment (vision/calibration). Nothing but the
/// pictures goes from one to the other. Throws InputError if the pictures do not suffice.
StereoCalibrationResult CalibrateWithBoards(const StereoRig& rig,
                                            const BoardSessionOptions& session,
                                            const RandomStream& stream);

/// All that a calibration with the choice's boards depends on, as text: equal texts, equal results,
/// with the same program. It names every factor of the stereo rig and its calibration, so that a
/// new one is not forgotten.
std::string ContentOf(const StereoRig& rig, const CalibrationChoice& choice,
                      const RandomStream& stream);

}  // namespace fenestra
