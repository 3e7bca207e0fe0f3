#include "sim/camera/color_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/io/faults.h"
#include "core/io/srgb.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

// Limits of automatic exposure: the shortest line time and one image at 30 Hz.
constexpr double kShortestExposure = 20e-6;
constexpr double kLongestExposure = 1.0 / 30.0;

// The zero of a function that does not fall, to within 0.01 of its value, or else the end that
// comes nearer to it. Regula falsi, with the Illinois rule of halving the value of an end that
// stays twice.
template <typename Function>
double RisingZero(double low, double high, const Function& f) {
  constexpr double kNear = 0.01;
  double f_low = f(low);
  double f_high = f(high);
  if (f_low >= -kNear) return low;
  if (f_high <= kNear) return high;
  int last_moved = 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = low + (high - low) * f_low / (f_low - f_high);
    const double f_middle = f(middle);
    if (std::abs(f_middle) <= kNear) return middle;
    const int moved = f_middle < 0.0 ? -1 : 1;
    (moved < 0 ? low : high) = middle;
    (moved < 0 ? f_low : f_high) = f_middle;
    if (moved == last_moved) (moved < 0 ? f_high : f_low) *= 0.5;
    last_moved = moved;
  }
  return 0.5 * (low + high);
}

RenderOptions RenderingOf(const ColorCameraOptions& options, int edge_samples_per_pixel) {
  return {.band = Band::kRgb,
          .samples_per_pixel = options.samples_per_pixel,
          .edge_samples_per_pixel = edge_samples_per_pixel,
          .edge_lines = options.edge_lines};
}

}  // namespace

CameraModel DesignOf(const ColorCameraOptions& o) {
  CameraParameters k = CameraModel::Pinhole(o.width_px, o.height_px, o.focal_px).parameters();
  k.distortion = o.distortion;
  return CameraModel(k);
}

void Validate(const ColorCameraOptions& o) {
  Faults faults("colour camera");
  faults.Require(o.lens.corner_blur_sigma_px >= o.lens.blur_sigma_px,
                 fmt::format("blur of {} px in the corners is less than {} px in the centre",
                             o.lens.corner_blur_sigma_px, o.lens.blur_sigma_px));
  faults.Require(o.mean_dn > 0.0 && o.mean_dn < 255.0,
                 "the image's mean must lie between 0 and 255");
  faults.ThrowIfAny();
  Validate(RollingShutter{.motion = {}, .readout_s = o.readout_s});
}

ColorCamera::ColorCamera(const ColorCameraOptions& options, const CameraModel& camera,
                         const Pose& X_BK, const RigMotion& motion, int edge_samples_per_pixel,
                         const RandomStream& pixels)
    : options_(Validated(options)),
      X_BK_(X_BK),
      shutter_{.motion = motion, .readout_s = options.readout_s},
      edge_samples_per_pixel_(edge_samples_per_pixel),
      rays_(camera),
      illumination_(RelativeIllumination(rays_, options.lens)),
      sensor_(options.sensor, {options.width_px, options.height_px}, pixels) {}

QuarterImages ColorCamera::LightDuring(double exposure_s, const RayCaster& caster,
                                       const Lighting& lighting, const Pose& X_WB,
                                       const RandomStream& sampling) const {
  const std::vector<RowBand> pictures = PicturesOf(shutter_, rays_.camera(), exposure_s);
  // Edges and quarters of pixels are found by neighbouring rows.
  constexpr int kMargin = 2;
  const cv::Size size(rays_.width_px(), rays_.height_px());
  QuarterImages sums;
  for (cv::Mat& sum : sums) sum = cv::Mat3f::zeros(size);
  std::vector<int> counts(static_cast<size_t>(size.height), 0);
  for (size_t i = 0; i < pictures.size(); ++i) {
    const RowBand& band = pictures[i];
    const int first = std::max(band.first - kMargin, 0);
    const int end = std::min(band.first + band.count + kMargin, size.height);
    const RayGrid rays(RowsOf(rays_.camera(), first, end - first));
    const Pose X_WK = PoseAt(X_WB, shutter_.motion, band.t_s) * X_BK_;
    const QuarterImages picture =
        caster.RenderQuarters(rays, X_WK, lighting, RenderingOf(options_, edge_samples_per_pixel_),
                              sampling.Child("picture", static_cast<uint64_t>(i)));
    for (size_t q = 0; q < sums.size(); ++q) {
      sums[q].rowRange(band.first, band.first + band.count) +=
          picture[q].rowRange(band.first - first, band.first - first + band.count);
    }
    for (int v = band.first; v < band.first + band.count; ++v) ++counts[static_cast<size_t>(v)];
  }
  for (int v = 0; v < size.height; ++v) {
    FENESTRA_CHECK(counts[static_cast<size_t>(v)] > 0, "a row that was never exposed");
    for (cv::Mat& sum : sums) sum.row(v) *= 1.0 / counts[static_cast<size_t>(v)];
  }
  return sums;
}

std::array<cv::Mat1f, 3> ColorCamera::ElectronsPerSecond(const QuarterImages& luminance) const {
  const std::array<double, 3> blur = {options_.blue_blur, 1.0, options_.red_blur};
  const auto gathered = [&](double scale) {
    return Gather(luminance, {.centre_sigma_px = scale * options_.lens.blur_sigma_px,
                              .corner_sigma_px = scale * options_.lens.corner_blur_sigma_px});
  };
  const double electrons_per_s =
      options_.electrons_per_lux_s * IlluminancePerLuminance(options_.lens);
  const cv::Mat green = gathered(1.0);
  std::array<cv::Mat1f, 3> channels;
  for (size_t i = 0; i < channels.size(); ++i) {
    cv::extractChannel(blur[i] == 1.0 ? green : gathered(blur[i]), channels[i],
                       static_cast<int>(i));
    channels[i] = WithVeilingGlare(channels[i].mul(illumination_, electrons_per_s),
                                   options_.lens.veiling_glare);
  }
  return channels;
}

cv::Mat3b ColorCamera::Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                               const RandomStream& shot) const {
  const RandomStream sampling = shot.Child("color_sampling");
  std::array<cv::Mat1f, 3> electrons_per_s;
  double exposure_s = options_.exposure_s;
  if (options_.auto_exposure || shutter_.motion.still()) {
    // The exposure is chosen by a picture without motion, which has much the same mean.
    electrons_per_s = ElectronsPerSecond(caster.RenderQuarters(
        rays_, X_WB * X_BK_, lighting, RenderingOf(options_, edge_samples_per_pixel_), sampling));
    exposure_s = Exposure(electrons_per_s);
  }
  if (!shutter_.motion.still()) {
    electrons_per_s = ElectronsPerSecond(LightDuring(exposure_s, caster, lighting, X_WB, sampling));
  }
  std::array<cv::Mat1b, 3> encoded;
  for (size_t i = 0; i < encoded.size(); ++i) {
    encoded[i] = Develop(electrons_per_s[i], exposure_s, shot.Child("color_noise", i));
  }
  cv::Mat3b color;
  cv::merge(encoded.data(), encoded.size(), color);
  return color;
}

cv::Mat1b ColorCamera::Develop(const cv::Mat1f& electrons_per_s, double exposure_s,
                               const RandomStream& noise) const {
  const cv::Mat1w dn =
      sensor_.Expose(electrons_per_s, {.exposure_s = exposure_s, .gain = 1.0}, noise);
  // The black level is subtracted before the encoding. There is a code for each value of the
  // sensor.
  const double black_dn = sensor_.BlackLevelDn();
  const double per_dn = 1.0 / (sensor_.FullScaleDn() - black_dn);
  cv::Mat1f linear(1, sensor_.FullScaleDn() + 1);
  for (int i = 0; i < linear.cols; ++i) linear(i) = static_cast<float>((i - black_dn) * per_dn);
  const cv::Mat1b codes = EncodeSrgb(linear);
  cv::Mat1b encoded(dn.size());
  std::transform(dn.begin(), dn.end(), encoded.begin(),
                 [table = codes[0]](uint16_t value) { return table[value]; });
  return encoded;
}

double ColorCamera::Exposure(const std::array<cv::Mat1f, 3>& electrons_per_s) const {
  if (!options_.auto_exposure) return options_.exposure_s;
  // The mean is computed without noise on every fourth pixel of every fourth row.
  std::array<cv::Mat1f, 3> sparse;
  for (size_t i = 0; i < sparse.size(); ++i) {
    cv::resize(electrons_per_s[i], sparse[i], {}, 0.25, 0.25, cv::INTER_NEAREST);
  }
  const auto excess_dn = [&](double log_exposure) {
    const double per_e = std::exp(log_exposure) / options_.sensor.saturation_e;
    double sum = 0.0;
    for (const cv::Mat1f& channel : sparse) sum += cv::mean(EncodeSrgb(channel * per_e))[0];
    return sum / 3.0 - options_.mean_dn;
  };
  return std::exp(RisingZero(std::log(kShortestExposure), std::log(kLongestExposure), excess_dn));
}

}  // namespace fenestra
