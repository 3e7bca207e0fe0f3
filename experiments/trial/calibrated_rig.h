#pragma once

#include <optional>
#include <string>

#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "experiments/study/trial_settings.h"
#include "experiments/trial/calibration_cache.h"
#include "sim/stereo/board_session.h"
#include "sim/stereo/stereo_rig.h"
#include "vision/calibration/bundle_adjustment.h"
#include "vision/calibration/stereo_calibration.h"

namespace fenestra {

/// A rig as it flies, and its nominal calibration, which detectors are given.
struct CalibratedRig {
  StereoRig rig;
  StereoCalibration nominal;
  /// Of the nominal calibration's error: see CalibrationCovariance. nullopt: there is no error.
  std::optional<PairMatrix> covariance;
};

/// Calibrates a rig that was just built, as the choice's source says:
///
///     kExact      the rig's own cameras
///     kPerturbed  the rig's own cameras with an error that is drawn, not made: what boards leave
///                 to first order (BoardErrors), then a turn and a shift of the right camera
///     kBoards     bundle adjustment of simulated pictures of a board (CalibrateWithBoards)
///     kStale      as kBoards, after which the right camera of the rig that flies is displaced
///     kDesign     the cameras of the rig's design
///
/// A pure function of all but the cache, which only saves
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

/// Calibrates a simulated rig as a real one is: pictures of a board of its own, within the
/// session's tolerances, through the rig's own optics and noise (sim/stereo/board_session),
/// corners, adjustment to the board as drawn (vision/calibration). Nothing but the pictures goes
/// from one to the other. Throws InputError if the pictures do not suffice.
StereoCalibrationResult CalibrateWithBoards(const StereoRig& rig,
                                            const BoardSessionOptions& session,
                                            const AdjustmentOptions& adjustment,
                                            const RandomStream& stream);

/// All that a calibration with the choice's boards depends on, as text: equal texts, equal results,
/// with the same program. It names every factor of the stereo rig and its calibration, so that a
/// new one is not forgotten.
std::string ContentOf(const StereoRig& rig, const CalibrationChoice& choice,
                      const RandomStream& stream);

}  // namespace fenestra
