#include "sim/stereo/stereo_camera.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/camera/spectral_response.h"

namespace fenestra {
namespace {

CameraModel Built(const StereoRigOptions& options, const RandomStream& camera) {
  const CameraModel design = DesignOf(options).left;
  return options.as_designed ? design : BuiltCamera(design, options.tolerances.camera(), camera);
}

// Grey values per electron of a camera as built, as a multiple of the design's.
double BuiltGain(const StereoRigOptions& options, const RandomStream& camera) {
  return options.as_designed ? 1.0 : 1.0 + options.tolerances.gain * camera.Child("gain").Normal(0);
}

ImageSensorOptions WithGain(ImageSensorOptions sensor, double gain) {
  sensor.saturation_e /= gain;
  return sensor;
}

// Two normal variates of this standard deviation; none for a camera as designed.
Eigen::Vector2d Scatter(const StereoRigOptions& options, double deviation,
                        const RandomStream& stream) {
  if (options.as_designed) return Eigen::Vector2d::Zero();
  return deviation * Eigen::Vector2d(stream.Normal(0), stream.Normal(1));
}

// The camera with pixels that are four times as large, fewer of them if need be.
CameraModel CoarseCamera(const CameraModel& camera) {
  constexpr int kLarger = 4;
  CameraParameters k = camera.parameters();
  k.width_px = std::max(k.width_px / kLarger, 1);
  k.height_px = std::max(k.height_px / kLarger, 1);
  k.fx_px /= kLarger;
  k.fy_px /= kLarger;
  // An integer coordinate is a pixel's centre.
  k.cx_px = (k.cx_px + 0.5) / kLarger - 0.5;
  k.cy_px = (k.cy_px + 0.5) / kLarger - 0.5;
  return CameraModel(k);
}

}  // namespace

StereoCamera::StereoCamera(const StereoRigOptions& options, const RandomStream& own)
    : options_(options),
      stream_(own),
      rays_(Built(options, own)),
      illumination_(RelativeIllumination(rays_, options.lens)),
      coarse_rays_(CoarseCamera(rays_.camera())),
      coarse_illumination_(RelativeIllumination(coarse_rays_, options.lens)),
      electrons_per_luminance_(ElectronsPerLuxSecond(options.spectrum, options.pixel_pitch_m) *
                               IlluminancePerLuminance(options.lens)),
      coma_centre_(Scatter(options, options.tolerances.coma_centre, own.Child("coma_centre"))),
      focus_{.focal_length_m = options.focal_length_m,
             .f_number = options.lens.f_number,
             .pixel_pitch_m = options.pixel_pitch_m,
             .distance_m = options.focus_distance_m,
             .tilt_rad =
                 Scatter(options, options.tolerances.sensor_tilt_rad, own.Child("sensor_tilt"))},
      gain_(BuiltGain(options, own)),
      sensor_(WithGain(options.sensor, gain_), {model().width_px(), model().height_px()}, own) {}

StereoCamera StereoCamera::With(const ImageSensorOptions& sensor) const {
  StereoCamera camera = *this;
  camera.sensor_ = ImageSensor(WithGain(sensor, gain_), sensor_.size(), stream_);
  return camera;
}

ExposureSetting StereoCamera::ExposureAt(const Pose& X_WC, const RayCaster& caster,
                                         const Lighting& lighting,
                                         const RandomStream& sampling) const {
  if (!options_.exposure.automatic) return ExposureFor(0.0);
  // Blur and veiling glare keep the mean.
  const cv::Mat1f luminance = caster.Render(
      coarse_rays_, X_WC, lighting,
      {.band = Band::kLuminance, .samples_per_pixel = 4, .edge_samples_per_pixel = 4}, sampling);
  return ExposureFor(electrons_per_luminance_ * cv::mean(luminance.mul(coarse_illumination_))[0]);
}

ExposureSetting StereoCamera::ExposureFor(double mean_electrons_per_s) const {
  return ChooseExposure(options_.exposure, sensor_.options(), mean_electrons_per_s);
}

PointSpread StereoCamera::SpreadInFocus() const {
  return {.centre_sigma_px = options_.lens.blur_sigma_px,
          .corner_sigma_px = options_.lens.corner_blur_sigma_px,
          .corner_coma_px = options_.corner_coma_px,
          .coma_centre = coma_centre_};
}

cv::Mat1f StereoCamera::InverseDistances(const Pose& X_WC, const RayCaster& caster) const {
  const cv::Mat1f depth_m = caster.CastAovs(coarse_rays_, X_WC, {}, {}).depth_m;
  cv::Mat1f inverse(depth_m.size());
  std::transform(depth_m.begin(), depth_m.end(), inverse.begin(),
                 [](float z_m) { return std::isnan(z_m) ? 0.0f : 1.0f / z_m; });
  return inverse;
}

PointSpread StereoCamera::SpreadAt(const cv::Mat1f& inverse_distances) const {
  cv::Mat1f inverse_distance;
  cv::resize(inverse_distances, inverse_distance, sensor_.size(), 0.0, 0.0, cv::INTER_LINEAR);
  PointSpread spread = SpreadInFocus();
  spread.confusion_px = CirclesOfConfusion(inverse_distance, focus_);
  return spread;
}

cv::Mat1f StereoCamera::ElectronsPerSecond(const QuarterImages& luminance,
                                           const PointSpread& spread) const {
  return WithVeilingGlare(Gather(luminance, spread).mul(illumination_, electrons_per_luminance_),
                          options_.lens.veiling_glare);
}

cv::Mat1b StereoCamera::Image(const cv::Mat1f& electrons_per_s, const ExposureSetting& exposure,
                              const RandomStream& noise) const {
  const cv::Mat1w dn = sensor_.Expose(electrons_per_s, exposure, noise);
  // More bits than an image holds are for measuring the sensor; a detector sees the upper eight.
  cv::Mat1b image;
  dn.convertTo(image, CV_8U, std::min(1.0, 255.0 / sensor_.FullScaleDn()));
  return image;
}

}  // namespace fenestra
