#include "sim/color_camera.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/input_error.h"
#include "sim/srgb.h"

namespace fenestra {
namespace {

// Limits of automatic exposure: the shortest line time and one frame at 30 Hz.
constexpr double kShortestExposure = 20e-6;
constexpr double kLongestExposure = 1.0 / 30.0;

}  // namespace

CameraModel DesignOf(const ColorCameraOptions& o) {
  return CameraModel::Pinhole(o.width_px, o.height_px, o.focal_px);
}

void Validate(const ColorCameraOptions& o) {
  std::vector<InputFault> faults;
  const auto demand = [&faults](bool holds, std::string message) {
    if (!holds) faults.push_back({"colour camera", 0, 0, std::move(message)});
  };
  demand(o.lens.corner_blur_sigma_px >= o.lens.blur_sigma_px,
         fmt::format("blur of {} px in the corners is less than {} px in the centre",
                     o.lens.corner_blur_sigma_px, o.lens.blur_sigma_px));
  demand(o.mean_dn > 0.0 && o.mean_dn < 255.0, "the image's mean must lie between 0 and 255");
  if (!faults.empty()) throw InputError(std::move(faults));
}

ColorCamera::ColorCamera(const ColorCameraOptions& options, int edge_samples_per_pixel)
    : options_((Validate(options), options)),
      edge_samples_per_pixel_(edge_samples_per_pixel),
      rays_(DesignOf(options)),
      illumination_(RelativeIllumination(rays_, options.lens)),
      // One fixed pattern: all cameras of a study are the same unit.
      sensor_(options.sensor, {options.width_px, options.height_px},
              RandomStream(0).Child("color_camera")) {}

cv::Mat3b ColorCamera::Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WK,
                               const RandomStream& shot) const {
  const RenderOptions render{.band = Band::kRgb,
                             .samples_per_pixel = 4,
                             .edge_samples_per_pixel = edge_samples_per_pixel_};
  const QuarterImages luminance =
      caster.RenderQuarters(rays_, X_WK, lighting, render, shot.Child("color_sampling"));
  std::array<cv::Mat1f, 3> channels;
  const std::array<double, 3> blur = {options_.blue_blur, 1.0, options_.red_blur};
  const double electrons_per_s =
      options_.electrons_per_lux_s * IlluminancePerLuminance(options_.lens);
  for (size_t i = 0; i < channels.size(); ++i) {
    QuarterImages quarters;
    for (size_t q = 0; q < quarters.size(); ++q) {
      cv::extractChannel(luminance[q], quarters[q], static_cast<int>(i));
    }
    channels[i] =
        Gather(quarters, {.centre_sigma_px = blur[i] * options_.lens.blur_sigma_px,
                          .corner_sigma_px = blur[i] * options_.lens.corner_blur_sigma_px})
            .mul(illumination_, electrons_per_s);
  }
  const double exposure_s = Exposure(channels);
  std::array<cv::Mat1b, 3> encoded;
  for (size_t i = 0; i < channels.size(); ++i) {
    encoded[i] = Develop(channels[i], exposure_s, shot.Child("color_noise", i));
  }
  cv::Mat3b color;
  cv::merge(encoded.data(), encoded.size(), color);
  return color;
}

cv::Mat1b ColorCamera::Develop(const cv::Mat1f& electrons_per_s, double exposure_s,
                               const RandomStream& frame) const {
  const cv::Mat1w dn =
      sensor_.Expose(electrons_per_s, {.exposure_s = exposure_s, .gain = 1.0}, frame);
  // Black is taken away before the encoding.
  const double black_dn = sensor_.BlackLevelDn();
  const double per_dn = 1.0 / (sensor_.FullScaleDn() - black_dn);
  cv::Mat1f linear;
  dn.convertTo(linear, CV_32F, per_dn, -black_dn * per_dn);
  return EncodeSrgb(linear);
}

double ColorCamera::Exposure(const std::array<cv::Mat1f, 3>& electrons_per_s) const {
  if (!options_.auto_exposure) return options_.exposure_s;
  // The encoded mean grows with exposure, but not linearly: bisect. Without noise, on every fourth
  // pixel of every fourth row.
  std::array<cv::Mat1f, 3> sparse;
  for (size_t i = 0; i < sparse.size(); ++i) {
    cv::resize(electrons_per_s[i], sparse[i], {}, 0.25, 0.25, cv::INTER_NEAREST);
  }
  const auto mean_dn = [&](double exposure_s) {
    double sum = 0.0;
    for (const cv::Mat1f& channel : sparse) {
      sum += cv::mean(EncodeSrgb(channel * (exposure_s / options_.sensor.saturation_e)))[0];
    }
    return sum / 3.0;
  };
  double low_s = kShortestExposure;
  double high_s = kLongestExposure;
  for (int i = 0; i < 24; ++i) {
    const double middle_s = std::sqrt(low_s * high_s);
    (mean_dn(middle_s) < options_.mean_dn ? low_s : high_s) = middle_s;
  }
  return std::sqrt(low_s * high_s);
}

}  // namespace fenestra
