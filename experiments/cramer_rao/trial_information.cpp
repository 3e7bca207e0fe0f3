#include "experiments/cramer_rao/trial_information.h"

#include <opencv2/core.hpp>

#include "core/io/srgb.h"
#include "experiments/cramer_rao/cramer_rao.h"
#include "experiments/cramer_rao/picture_information.h"
#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {
namespace {

constexpr int kPair = kFrameUnknowns;
constexpr int kPairBlurs = kPair + kPairParameters;
constexpr int kPairLevels = kPairBlurs + 2;
constexpr int kPairUnknowns = kPairLevels + 2 * kLevelsOfPicture;

constexpr int kChannels = 3;
constexpr int kColorBlurs = kDepthUnknowns;
constexpr int kColorLevels = kColorBlurs + kChannels;
constexpr int kColorUnknowns = kColorLevels + kChannels * kLevelsOfPicture;

// Photo-electrons of sRGB values.
cv::Mat1f Decoded(const cv::Mat3b& color, int channel, double full_scale_e) {
  cv::Mat1f linear(1, 256);
  for (int i = 0; i < 256; ++i) {
    linear(i) = static_cast<float>(full_scale_e * LinearFromSrgb(i / 255.0));
  }
  cv::Mat1b values;
  cv::extractChannel(color, values, channel);
  cv::Mat1f electrons;
  cv::LUT(values, linear, electrons);
  return electrons;
}

std::optional<double> NumberOption(const DetectorChoice& detector, const char* name) {
  const auto option = detector.options.find(name);
  if (option == detector.options.end()) return std::nullopt;
  const double* number = std::get_if<double>(&option->second);
  return number != nullptr ? std::optional(*number) : std::nullopt;
}

}  // namespace

std::optional<Eigen::MatrixXd> StereoInformation(const FrameState& frame,
                                                 const StereoPictures& pictures) {
  const StereoCalibration& cameras = pictures.cameras;
  const ElectronPicture left{.camera = cameras.left,
                             .X_VC = Pose(),
                             .electrons = pictures.left.electrons,
                             .noise = pictures.left.noise,
                             .spread = pictures.left.spread,
                             .blur_unknown = kPairBlurs,
                             .level_unknown = kPairLevels,
                             .camera_unknown = kPair};
  const ElectronPicture right{.camera = cameras.right,
                              .X_VC = cameras.X_RL,
                              .electrons = pictures.right.electrons,
                              .noise = pictures.right.noise,
                              .spread = pictures.right.spread,
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

std::optional<Eigen::MatrixXd> RgbdInformation(const FrameState& frame,
                                               const StructuredLightSensor& sensor,
                                               const cv::Mat3b& color, const DepthMatrix& depth) {
  const RgbdCalibration& cameras = sensor.cameras();
  const ColorCameraOptions& options = sensor.options().color;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kColorUnknowns, kColorUnknowns);
  information.topLeftCorner<kDepthUnknowns, kDepthUnknowns>() = depth;
  const PixelNoise noise = PixelNoise::Encoded(options.sensor, {.exposure_s = 0.0, .gain = 1.0});
  const std::array<double, kChannels> blur = {options.blue_blur, 1.0, options.red_blur};
  for (int channel = 0; channel < kChannels; ++channel) {
    const double scale = blur[static_cast<size_t>(channel)];
    const cv::Mat1f electrons = Decoded(color, channel, noise.full_scale_e());
    const ElectronPicture view{
        .camera = cameras.color,
        .X_VC = cameras.X_KD,
        .electrons = electrons,
        .noise = noise,
        .spread = {.centre_sigma_px = scale * options.lens.blur_sigma_px,
                   .corner_sigma_px = scale * options.lens.corner_blur_sigma_px},
        .blur_unknown = kColorBlurs + channel,
        .level_unknown = kColorLevels + channel * kLevelsOfPicture,
        .camera_unknown = kUnitUnknown,
        // Depth that is registered to the colour camera is scored in it.
        .pose_unknown = sensor.options().registered_depth
                            ? std::nullopt
                            : std::optional(kUnitUnknown + kUnitPose)};
    const auto picture = PictureInformation(frame, view, kColorUnknowns);
    if (!picture) return std::nullopt;
    information += *picture;
  }
  return information;
}

std::optional<Eigen::Matrix3d> RgbdBound(const Eigen::MatrixXd& information,
                                         const PriorKnowledge& knowledge) {
  Eigen::MatrixXd known = WithSizePrior(information, knowledge);
  known = knowledge.calibration ? WithNuisance(known, kUnitUnknown, *knowledge.calibration)
                                : WithKnown(known, kUnitUnknown, kUnitParameters);
  if (knowledge.wall_sigma_m) {
    known(kWallUnknown, kWallUnknown) += 1.0 / (*knowledge.wall_sigma_m * *knowledge.wall_sigma_m);
  } else {
    known = WithKnown(known, kWallUnknown, 1);
  }
  const auto bound = CramerRaoBound(known, kCentroidUnknowns);
  return bound ? std::optional<Eigen::Matrix3d>(*bound) : std::nullopt;
}

std::optional<TrialInformation> InformationOf(const StereoRig& rig, const StereoShot& shot,
                                              const GroundTruth& truth, double border_m,
                                              const std::optional<Eigen::MatrixXd>& calibration) {
  if (!truth.target || !truth.in_view) return std::nullopt;
  const auto picture_of = [](const ExposedView& view) {
    return StereoPicture{.electrons = view.electrons,
                         .noise = PixelNoise::Linear(view.sensor, view.exposure),
                         .spread = view.spread};
  };
  const auto fisher = StereoInformation(
      FrameState::Of(*truth.target, border_m),
      {.cameras = rig.cameras(), .left = picture_of(shot.left), .right = picture_of(shot.right)});
  if (!fisher) return std::nullopt;
  return TrialInformation{SensorKind::kStereo, *fisher, calibration};
}

std::optional<TrialInformation> InformationOf(const StructuredLightSensor& sensor,
                                              const DepthTheory& theory,
                                              const RgbdObservation& observation,
                                              const GroundTruth& truth, const TargetOptions& target,
                                              const RayCaster& caster, const Lighting& lighting,
                                              const Pose& X_WB,
                                              const std::optional<Eigen::MatrixXd>& calibration) {
  if (!truth.target || !truth.in_view) return std::nullopt;
  const FrameState frame = FrameState::Of(*truth.target, target.border_m);
  const DepthMatrix depth =
      theory.Information(frame, target.setback_m, observation.depth, caster, lighting, X_WB);
  const auto fisher = RgbdInformation(frame, sensor, observation.color, depth);
  if (!fisher) return std::nullopt;
  return TrialInformation{SensorKind::kRgbd, *fisher, calibration};
}

std::optional<Eigen::Matrix3d> BoundOf(const TrialInformation& information,
                                       const PriorKnowledge& knowledge) {
  return information.sensor == SensorKind::kStereo ? StereoBound(information.fisher, knowledge)
                                                   : RgbdBound(information.fisher, knowledge);
}

PriorKnowledge PriorKnowledgeOf(const DetectorChoice& detector,
                                const TrialInformation& information) {
  PriorKnowledge knowledge{.size_sigma_m = {}, .calibration = information.calibration};
  const auto expected_m = NumberOption(detector, "expected_width_m");
  if (expected_m && *expected_m > 0.0) {
    knowledge.size_sigma_m = NumberOption(detector, "expected_size_sigma_m");
  }
  return knowledge;
}

}  // namespace fenestra
