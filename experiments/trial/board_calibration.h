#pragma once

#include <string>

#include "sim/stereo/board_session.h"
#include "vision/calibration/stereo_calibration.h"

namespace fenestra {

/// Calibrates a simulated rig as a real one is: pictures of a board through its own optics and
/// noise (sim/stereo/board_session), corners, adjustment (vision/calibration). Nothing but the
/// pictures goes from one to the other. Throws InputError if the pictures do not suffice.
StereoCalibrationResult CalibrateWithBoards(const StereoRig& rig,
                                            const BoardSessionOptions& session,
                                            const RandomStream& stream);

/// All that the result of CalibrateWithBoards depends on, as text: equal texts, equal results, with
/// the same program.
std::string ContentOf(const StereoRig& rig, const BoardSessionOptions& session,
                      const RandomStream& stream);

}  // namespace fenestra
