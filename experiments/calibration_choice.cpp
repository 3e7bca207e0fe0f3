#include "experiments/calibration_choice.h"

namespace fenestra {
namespace {

Eigen::Vector3d NormalVector(const RandomStream& stream, double sigma) {
  return sigma * Eigen::Vector3d(stream.Normal(0), stream.Normal(1), stream.Normal(2));
}

StereoCalibration Perturbed(const StereoCalibration& truth, const CalibrationChoice& choice,
                            const RandomStream& stream) {
  const Pose error(
      RotationFromVector(NormalVector(stream.Child("rotation"), choice.rotation_error_rad)),
      NormalVector(stream.Child("translation"), choice.translation_error_m));
  return {.left = truth.left, .right = truth.right, .X_RL = error * truth.X_RL};
}

}  // namespace

StereoCalibration CalibrationOf(const StereoRig& rig, const CalibrationChoice& choice,
                                const RandomStream& calibration) {
  switch (choice.source) {
    case CalibrationSource::kExact:
      return rig.cameras();
    case CalibrationSource::kPerturbed:
      return Perturbed(rig.cameras(), choice, calibration);
    case CalibrationSource::kDesign:
      return DesignOf(rig.options());
  }
  return rig.cameras();
}

}  // namespace fenestra
