#include "experiments/trial/calibrated_rig.h"

#include "core/random/random_stream.h"
#include "experiments/cramer_rao/calibration_covariance.h"
#include "experiments/trial/board_calibration.h"

namespace fenestra {
namespace {

StereoCalibration Perturbed(const StereoCalibration& truth, const CalibrationChoice& choice,
                            const RandomStream& stream) {
  const Pose error = RandomPose(stream, choice.rotation_error_rad, choice.translation_error_m);
  return {.left = truth.left, .right = truth.right, .X_RL = error * truth.X_RL};
}

StatedCalibration WithBoards(const StereoRig& rig, const CalibrationChoice& choice,
                             const RandomStream& stream, const CalibrationCache& cache) {
  BoardSessionOptions session;
  session.board.kind = choice.board;
  session.views = choice.boards;
  // A study that leaves the noise out of its pictures asks what the calibration alone does: the
  // pictures of the boards have theirs.
  const StereoRig noisy = rig.WithNoise();
  const auto calibrate = [&] {
    const StereoCalibrationResult result = CalibrateWithBoards(noisy, session, stream);
    return StatedCalibration{result.calibration, result.covariance};
  };
  return cache.Get(ContentOf(noisy, choice, stream), calibrate);
}

}  // namespace

CalibratedRig Calibrated(const StereoRig& rig, const CalibrationChoice& choice,
                         const RandomStream& calibration, const CalibrationCache& cache) {
  const auto with_covariance = [&choice](const StereoRig& flown, const StereoCalibration& nominal,
                                         const std::optional<PairMatrix>& boards = {}) {
    return CalibratedRig{flown, nominal, CalibrationCovariance(flown, choice, boards)};
  };
  const auto with_boards = [&](const StereoRig& flown) {
    const StatedCalibration measured = WithBoards(rig, choice, calibration.Child("boards"), cache);
    return with_covariance(flown, measured.calibration, measured.covariance);
  };
  switch (choice.source) {
    case CalibrationSource::kExact:
      return with_covariance(rig, rig.cameras());
    case CalibrationSource::kPerturbed:
      return with_covariance(rig, Perturbed(rig.cameras(), choice, calibration));
    case CalibrationSource::kBoards:
      return with_boards(rig);
    case CalibrationSource::kStale:
      return with_boards(rig.Displaced(RandomPose(
          calibration.Child("shake"), choice.shake_rotation_rad, choice.shake_translation_m)));
    case CalibrationSource::kDesign:
      return with_covariance(rig, DesignOf(rig.options()));
  }
  return with_covariance(rig, rig.cameras());
}

}  // namespace fenestra
