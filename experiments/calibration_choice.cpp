#include "experiments/calibration_choice.h"

#include "experiments/board_calibration.h"

namespace fenestra {
namespace {

Eigen::Vector3d NormalVector(const RandomStream& stream, double sigma) {
  return sigma * Eigen::Vector3d(stream.Normal(0), stream.Normal(1), stream.Normal(2));
}

Pose RandomPose(const RandomStream& stream, double rotation_rad, double translation_m) {
  return Pose(RotationFromVector(NormalVector(stream.Child("rotation"), rotation_rad)),
              NormalVector(stream.Child("translation"), translation_m));
}

StereoCalibration Perturbed(const StereoCalibration& truth, const CalibrationChoice& choice,
                            const RandomStream& stream) {
  const Pose error = RandomPose(stream, choice.rotation_error_rad, choice.translation_error_m);
  return {.left = truth.left, .right = truth.right, .X_RL = error * truth.X_RL};
}

StereoCalibration WithBoards(const StereoRig& rig, const CalibrationChoice& choice,
                             const RandomStream& stream, const CalibrationCache& cache) {
  BoardSessionOptions session;
  session.board.kind = choice.board;
  session.views = choice.boards;
  // A study that leaves the noise out of its pictures asks what the calibration alone does: the
  // pictures of the boards have theirs.
  const StereoRig noisy = rig.WithNoise();
  const auto calibrate = [&] { return CalibrateWithBoards(noisy, session, stream).calibration; };
  return cache.Get(ContentOf(noisy, session, stream), calibrate);
}

}  // namespace

CalibratedRig Calibrated(const StereoRig& rig, const CalibrationChoice& choice,
                         const RandomStream& calibration, const CalibrationCache& cache) {
  switch (choice.source) {
    case CalibrationSource::kExact:
      return {rig, rig.cameras()};
    case CalibrationSource::kPerturbed:
      return {rig, Perturbed(rig.cameras(), choice, calibration)};
    case CalibrationSource::kBoards:
      return {rig, WithBoards(rig, choice, calibration.Child("boards"), cache)};
    case CalibrationSource::kStale: {
      const Pose X_RRnew = RandomPose(calibration.Child("shake"), choice.shake_rotation_rad,
                                      choice.shake_translation_m);
      return {rig.Displaced(X_RRnew), WithBoards(rig, choice, calibration.Child("boards"), cache)};
    }
    case CalibrationSource::kDesign:
      return {rig, DesignOf(rig.options())};
  }
  return {rig, rig.cameras()};
}

}  // namespace fenestra
