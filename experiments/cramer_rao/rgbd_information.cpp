#include "experiments/cramer_rao/rgbd_information.h"

#include <opencv2/core.hpp>

#include "core/io/srgb.h"
#include "experiments/cramer_rao/cramer_rao.h"
#include "experiments/cramer_rao/picture_information.h"

namespace fenestra {
namespace {

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

}  // namespace

std::optional<Eigen::MatrixXd> RgbdInformation(const FrameState& frame,
                                               const RgbdCalibration& cameras,
                                               const ColorCameraOptions& options,
                                               const cv::Mat3b& color, const DepthMatrix& depth) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kColorUnknowns, kColorUnknowns);
  information.topLeftCorner<kDepthUnknowns, kDepthUnknowns>() = depth;
  const PixelNoise noise = PixelNoise::Encoded(options.sensor, {.exposure_s = 0.0, .gain = 1.0});
  const std::array<double, kChannels> blur = {options.blue_blur, 1.0, options.red_blur};
  for (int channel = 0; channel < kChannels; ++channel) {
    const double scale = blur[static_cast<size_t>(channel)];
    const cv::Mat1f electrons = Decoded(color, channel, noise.full_scale_e());
    const ElectronPicture view{.camera = cameras.color,
                           .X_VC = cameras.X_KD,
                           .electrons = electrons,
                           .noise = noise,
                           .spread = {.centre_sigma_px = scale * options.lens.blur_sigma_px,
                                      .corner_sigma_px = scale * options.lens.corner_blur_sigma_px},
                           .blur_unknown = kColorBlurs + channel,
                           .level_unknown = kColorLevels + channel * kLevelsOfPicture};
    const auto picture = PictureInformation(frame, view, kColorUnknowns);
    if (!picture) return std::nullopt;
    information += *picture;
  }
  return information;
}

std::optional<Eigen::Matrix3d> RgbdBound(const Eigen::MatrixXd& information,
                                         const PriorKnowledge& knowledge) {
  Eigen::MatrixXd known = WithSizePrior(information, knowledge);
  if (knowledge.wall_sigma_m) {
    known(kWallUnknown, kWallUnknown) += 1.0 / (*knowledge.wall_sigma_m * *knowledge.wall_sigma_m);
  } else {
    known = WithKnown(known, kWallUnknown, 1);
  }
  const auto bound = CramerRaoBound(known, kCentroidUnknowns);
  return bound ? std::optional<Eigen::Matrix3d>(*bound) : std::nullopt;
}

}  // namespace fenestra
