#include "experiments/cramer_rao/stereo_information.h"

#include "experiments/cramer_rao/cramer_rao.h"
#include "experiments/cramer_rao/picture_information.h"

namespace fenestra {
namespace {

constexpr int kPair = kFrameUnknowns;
constexpr int kPairBlurs = kPair + kPairParameters;
constexpr int kPairLevels = kPairBlurs + 2;
constexpr int kPairUnknowns = kPairLevels + 2 * kLevelsOfPicture;

}  // namespace

std::optional<Eigen::MatrixXd> StereoInformation(const FrameState& frame,
                                                 const StereoPictures& pictures) {
  const StereoCalibration& cameras = pictures.cameras;
  const ElectronPicture left{.camera = cameras.left,
                         .X_VC = Pose(),
                         .electrons = pictures.left_e,
                         .noise = pictures.noise,
                         .spread = pictures.spread,
                         .blur_unknown = kPairBlurs,
                         .level_unknown = kPairLevels,
                         .camera_unknown = kPair};
  const ElectronPicture right{.camera = cameras.right,
                          .X_VC = cameras.X_RL,
                          .electrons = pictures.right_e,
                          .noise = pictures.noise,
                          .spread = pictures.spread,
                          .blur_unknown = kPairBlurs + 1,
                          .level_unknown = kPairLevels + kLevelsOfPicture,
                          .camera_unknown = kPair + kCameraParameters,
                          .pose_unknown = kPair + 2 * kCameraParameters};
  const auto by_left = PictureInformation(frame, left, kPairUnknowns);
  const auto by_right = PictureInformation(frame, right, kPairUnknowns);
  if (!by_left || !by_right) return std::nullopt;
  return Eigen::MatrixXd(*by_left + *by_right);
}

std::optional<Eigen::Matrix3d> StereoBound(const Eigen::MatrixXd& information,
                                           const PriorKnowledge& knowledge) {
  Eigen::MatrixXd known = WithSizePrior(information, knowledge);
  known = knowledge.calibration ? WithNuisance(known, kPair, *knowledge.calibration)
                                : WithKnown(known, kPair, kPairParameters);
  const auto bound = CramerRaoBound(known, kCentroidUnknowns);
  return bound ? std::optional<Eigen::Matrix3d>(*bound) : std::nullopt;
}

}  // namespace fenestra
