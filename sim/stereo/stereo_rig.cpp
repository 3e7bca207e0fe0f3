#include "sim/stereo/stereo_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/io/faults.h"
#include "core/random/random_stream.h"

namespace fenestra {
namespace {

// Assumes positive lengths.
CameraModel DesignedCamera(const StereoRigOptions& options) {
  const double f_px = options.focal_length_m / options.pixel_pitch_m;
  return CameraModel({.width_px = options.width_px,
                      .height_px = options.height_px,
                      .fx_px = f_px,
                      .fy_px = f_px,
                      .cx_px = 0.5 * (options.width_px - 1),
                      .cy_px = 0.5 * (options.height_px - 1),
                      .distortion = options.distortion});
}

bool DistortionIsInvertible(const CameraModel& camera) {
  for (const double u : {-0.5, camera.width_px() - 0.5}) {
    for (const double v : {-0.5, camera.height_px() - 0.5}) {
      if (!camera.UnprojectRay({u, v})) return false;
    }
  }
  return true;
}

Pose DesignedLeft(double baseline_m) {
  return Pose::Translation({-0.5 * baseline_m, 0.0, 0.0});
}
Pose DesignedRight(double baseline_m) {
  return Pose::Translation({0.5 * baseline_m, 0.0, 0.0});
}

CameraModel BuiltCamera(const StereoRigOptions& options, const RandomStream& camera) {
  if (options.as_designed) return DesignedCamera(options);
  const RigTolerances& tolerances = options.tolerances;
  CameraParameters built = DesignedCamera(options).parameters();
  const double focal = 1.0 + tolerances.focal_length * camera.Child("focal_length").Normal(0);
  built.fx_px *= focal;
  built.fy_px *= focal;
  const RandomStream principal_point = camera.Child("principal_point");
  built.cx_px += tolerances.principal_point_px * principal_point.Normal(0);
  built.cy_px += tolerances.principal_point_px * principal_point.Normal(1);
  const RandomStream distortion = camera.Child("distortion");
  BrownConrady& d = built.distortion;
  uint64_t index = 0;
  for (double* coefficient : {&d.k1, &d.k2, &d.p1, &d.p2, &d.k3}) {
    *coefficient *= 1.0 + tolerances.distortion * distortion.Normal(index++);
  }
  return CameraModel(built);
}

// The displacement of a camera from its place in the design.
Pose Mounting(const StereoRigOptions& options, const RandomStream& camera) {
  if (options.as_designed) return Pose();
  const RigTolerances& tolerances = options.tolerances;
  return RandomPose(camera, tolerances.rotation_rad, tolerances.translation_m);
}

// Grey values per electron of a camera as built, as a multiple of the design's.
double BuiltGain(const StereoRigOptions& options, const RandomStream& camera) {
  return options.as_designed ? 1.0 : 1.0 + options.tolerances.gain * camera.Child("gain").Normal(0);
}

ImageSensorOptions WithGain(ImageSensorOptions sensor, double gain) {
  sensor.saturation_e /= gain;
  return sensor;
}

// The camera with pixels that are four times as large, fewer of them if need be.
CameraModel MeteringCamera(const CameraModel& camera) {
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

// Positions of the left image's surface points in the right image, as differences of pixels.
cv::Mat2f MatchesOf(const cv::Mat1f& depth_m, const StereoCalibration& cameras, const Pose& X_RL) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  cv::Mat2f matches(depth_m.size(), cv::Vec2f(kNone, kNone));
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const auto ray = cameras.left.UnprojectRay({u, v});
      if (!ray || std::isnan(depth_m(v, u))) continue;
      const auto right = cameras.right.Project(X_RL * Eigen::Vector3d(*ray * depth_m(v, u)));
      if (!right) continue;
      const bool inside = right->x() >= -0.5 && right->x() < depth_m.cols - 0.5 &&
                          right->y() >= -0.5 && right->y() < depth_m.rows - 0.5;
      if (!inside) continue;
      matches(v, u) =
          cv::Vec2f(static_cast<float>(u - right->x()), static_cast<float>(v - right->y()));
    }
  }
  return matches;
}

// The largest radius of the image in normalised coordinates.
double LargestRadius(const RayGrid& rays) {
  double largest2 = 0.0;
  for (const int u : {0, rays.width_px()}) {
    for (const int v : {0, rays.height_px()}) {
      largest2 = std::max<double>(largest2, rays.Corner(u, v).squaredNorm());
    }
  }
  return std::sqrt(largest2);
}

}  // namespace

void Validate(const StereoRigOptions& o) {
  Faults faults("stereo rig");
  faults.Require(o.pixel_pitch_m > 0.0,
                 fmt::format("pixel pitch {} m is not positive", o.pixel_pitch_m));
  faults.Require(o.focal_length_m > 0.0,
                 fmt::format("focal length {} m is not positive", o.focal_length_m));
  faults.Require(o.baseline_m > 0.0, fmt::format("baseline {} m is not positive", o.baseline_m));
  faults.Require(o.lens.f_number > 0.0,
                 fmt::format("f-number {} is not positive", o.lens.f_number));
  faults.Require(o.exposure.shortest_s <= o.exposure.longest_s,
                 fmt::format("shortest exposure {} s is longer than the longest, {} s",
                             o.exposure.shortest_s, o.exposure.longest_s));
  faults.Require(o.lens.blur_sigma_px >= 0.0 && o.lens.corner_blur_sigma_px >= o.lens.blur_sigma_px,
                 fmt::format("blur {} px in the corners is less than {} px in the centre",
                             o.lens.corner_blur_sigma_px, o.lens.blur_sigma_px));
  const RigTolerances& t = o.tolerances;
  faults.Require(t.focal_length >= 0.0 && t.principal_point_px >= 0.0 && t.distortion >= 0.0 &&
                     t.rotation_rad >= 0.0 && t.translation_m >= 0.0 && t.gain >= 0.0,
                 "tolerances must not be negative");
  if (faults.count() == 0 && !DistortionIsInvertible(DesignedCamera(o))) {
    faults.Add("the distortion folds the image over before its corners");
  }
  faults.ThrowIfAny();
}

StereoCalibration DesignOf(const StereoRigOptions& options) {
  Validate(options);
  return {.left = DesignedCamera(options),
          .right = DesignedCamera(options),
          .X_RL = DesignedRight(options.baseline_m).inverse() * DesignedLeft(options.baseline_m)};
}

StereoRig::Camera::Camera(const CameraModel& model, const StereoRigOptions& options,
                          const RandomStream& own)
    : stream(own),
      rays(model),
      illumination(RelativeIllumination(rays, options.lens)),
      metering_rays(MeteringCamera(model)),
      metering_illumination(RelativeIllumination(metering_rays, options.lens)),
      gain(BuiltGain(options, own)),
      sensor(WithGain(options.sensor, gain), {model.width_px(), model.height_px()}, own) {}

void StereoRig::Camera::SetSensor(const ImageSensorOptions& options) {
  sensor = ImageSensor(WithGain(options, gain), sensor.size(), stream);
}

StereoRig::StereoRig(const StereoRigOptions& options, const RandomStream& rig)
    : options_(Validated(options)),
      cameras_{.left = BuiltCamera(options, rig.Child("left")),
               .right = BuiltCamera(options, rig.Child("right")),
               .X_RL = {}},
      X_BL_(DesignedLeft(options.baseline_m) * Mounting(options, rig.Child("left"))),
      pattern_key_(rig.key()),
      left_(std::make_shared<const Camera>(cameras_.left, options, rig.Child("left"))),
      right_(std::make_shared<const Camera>(cameras_.right, options, rig.Child("right"))) {
  const Pose X_BR = DesignedRight(options.baseline_m) * Mounting(options, rig.Child("right"));
  cameras_.X_RL = X_BR.inverse() * X_BL_;
}

StereoRig StereoRig::Displaced(const Pose& X_RRnew) const {
  StereoRig displaced = *this;
  displaced.cameras_.X_RL = X_RRnew.inverse() * cameras_.X_RL;
  return displaced;
}

StereoRig StereoRig::Still() const {
  StereoRig still = *this;
  still.options_.motion = {};
  still.options_.trigger_skew_s = 0.0;
  return still;
}

StereoRig StereoRig::WithNoise() const {
  if (options_.sensor.noise && options_.sensor.fixed_pattern) return *this;
  StereoRig noisy = *this;
  noisy.options_.sensor.noise = true;
  noisy.options_.sensor.fixed_pattern = true;
  for (std::shared_ptr<const Camera>* side : {&noisy.left_, &noisy.right_}) {
    Camera camera = **side;
    camera.SetSensor(noisy.options_.sensor);
    *side = std::make_shared<const Camera>(std::move(camera));
  }
  return noisy;
}

QuarterImages StereoRig::Light(const Camera& camera, const Pose& X_BC, const RayCaster& caster,
                               const Lighting& lighting, const Pose& X_WB, double t_s,
                               double exposure_s, const RandomStream& sampling) const {
  const RenderOptions render{.band = Band::kLuminance,
                             .samples_per_pixel = 4,
                             .edge_samples_per_pixel = options_.edge_samples_per_pixel};
  // Pictures in between, half a pixel apart at the fastest: the pixel's own area joins them up.
  constexpr double kStep_px = 0.5;
  constexpr double kMostPictures = 64.0;
  // Assumes that nothing is closer to the camera.
  constexpr double kNearest_m = 0.5;
  const double motion_px =
      ImageMotion(options_.motion, exposure_s, camera.rays.camera().parameters().fx_px,
                  LargestRadius(camera.rays), kNearest_m);
  const int pictures =
      std::max(1, static_cast<int>(std::ceil(std::min(motion_px / kStep_px, kMostPictures))));
  QuarterImages sum;
  for (int i = 0; i < pictures; ++i) {
    const double middle_s = t_s + ((i + 0.5) / pictures - 0.5) * exposure_s;
    const Pose X_WC = PoseAt(X_WB, options_.motion, middle_s) * X_BC;
    QuarterImages picture = caster.RenderQuarters(
        camera.rays, X_WC, lighting, render, sampling.Child("picture", static_cast<uint64_t>(i)));
    if (pictures == 1) return picture;
    for (size_t q = 0; q < sum.size(); ++q) {
      const cv::Mat share = picture[q] / pictures;
      sum[q] = i == 0 ? share : cv::Mat(sum[q] + share);
    }
  }
  return sum;
}

cv::Mat1f StereoRig::ElectronsPerSecond(const Camera& camera, const QuarterImages& light) const {
  const cv::Mat gathered = Gather(light, {.centre_sigma_px = options_.lens.blur_sigma_px,
                                          .corner_sigma_px = options_.lens.corner_blur_sigma_px});
  return WithVeilingGlare(gathered.mul(camera.illumination, ElectronsPerLuminance()),
                          options_.lens.veiling_glare);
}

double StereoRig::ElectronsPerLuminance() const {
  return ElectronsPerLuxSecond(options_.spectrum, options_.pixel_pitch_m) *
         IlluminancePerLuminance(options_.lens);
}

double StereoRig::MeanElectronsPerSecond(const Camera& camera, const Pose& X_WC,
                                         const RayCaster& caster, const Lighting& lighting,
                                         const RandomStream& sampling) const {
  // Blur and veiling glare keep the mean.
  const cv::Mat1f luminance = caster.Render(
      camera.metering_rays, X_WC, lighting,
      {.band = Band::kLuminance, .samples_per_pixel = 4, .edge_samples_per_pixel = 4}, sampling);
  return ElectronsPerLuminance() * cv::mean(luminance.mul(camera.metering_illumination))[0];
}

ExposureSetting StereoRig::ExposureFor(const Camera& camera, double mean_electrons_per_s) const {
  return ChooseExposure(options_.exposure, camera.sensor.options(), mean_electrons_per_s);
}

ExposedView StereoRig::Exposed(const Camera& camera, const cv::Mat1f& electrons_per_s,
                               const ExposureSetting& exposure) {
  return {.exposure = exposure,
          .sensor = camera.sensor.options(),
          .electrons = electrons_per_s * exposure.exposure_s};
}

cv::Mat1b StereoRig::ImageOf(const Camera& camera, const cv::Mat1f& electrons_per_s,
                             const ExposureSetting& exposure, const RandomStream& noise) {
  const cv::Mat1w dn = camera.sensor.Expose(electrons_per_s, exposure, noise);
  // More bits than an image holds are for measuring the sensor; a detector sees the upper eight.
  cv::Mat1b image;
  dn.convertTo(image, CV_8U, std::min(1.0, 255.0 / camera.sensor.FullScaleDn()));
  return image;
}

StereoObservation StereoRig::Develop(const QuarterImages& left, const QuarterImages& right,
                                     const RandomStream& shot) const {
  const cv::Mat1f left_e_s = ElectronsPerSecond(*left_, left);
  const cv::Mat1f right_e_s = ElectronsPerSecond(*right_, right);
  const ExposureSetting of_left = ExposureFor(*left_, cv::mean(left_e_s)[0]);
  const ExposureSetting of_right =
      options_.own_exposure ? ExposureFor(*right_, cv::mean(right_e_s)[0]) : of_left;
  return {.left = ImageOf(*left_, left_e_s, of_left, shot.Child("left_noise")),
          .right = ImageOf(*right_, right_e_s, of_right, shot.Child("right_noise"))};
}

StereoObservation StereoRig::Observe(const RayCaster& caster, const Lighting& lighting,
                                     const Pose& X_WB, const RandomStream& shot) const {
  return Shoot(caster, lighting, X_WB, shot).observation;
}

StereoShot StereoRig::Shoot(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                            const RandomStream& shot) const {
  const RandomStream left_sampling = shot.Child("left_sampling");
  const RandomStream right_sampling = shot.Child("right_sampling");
  const auto exposure_of = [&](const Camera& camera, const Pose& X_BC,
                               const RandomStream& sampling) {
    if (!options_.exposure.automatic) return ExposureFor(camera, 0.0);
    return ExposureFor(camera, MeanElectronsPerSecond(camera, X_WB * X_BC, caster, lighting,
                                                      sampling.Child("metering")));
  };
  const ExposureSetting of_left = exposure_of(*left_, X_BL_, left_sampling);
  const ExposureSetting of_right =
      options_.own_exposure ? exposure_of(*right_, X_BR(), right_sampling) : of_left;
  const double right_middle_s =
      options_.trigger_skew_s + 0.5 * (of_right.exposure_s - of_left.exposure_s);
  const cv::Mat1f left = ElectronsPerSecond(
      *left_, Light(*left_, X_BL_, caster, lighting, X_WB, 0.0, of_left.exposure_s, left_sampling));
  const cv::Mat1f right =
      ElectronsPerSecond(*right_, Light(*right_, X_BR(), caster, lighting, X_WB, right_middle_s,
                                        of_right.exposure_s, right_sampling));
  return {.observation = {.left = ImageOf(*left_, left, of_left, shot.Child("left_noise")),
                          .right = ImageOf(*right_, right, of_right, shot.Child("right_noise"))},
          .left = Exposed(*left_, left, of_left),
          .right = Exposed(*right_, right, of_right)};
}

GroundTruth StereoRig::Truth(const Scene& scene, const Pose& X_WB) const {
  const Pose X_WL = X_WB * X_BL_;
  const std::array<PlacedCamera, 2> placed = {PlacedCamera{cameras_.left, X_WL},
                                              PlacedCamera{cameras_.right, X_WB * X_BR()}};
  return MakeGroundTruth(scene, X_WL, placed);
}

TruthImages StereoRig::PixelTruth(const RayCaster& caster, const Lighting& lighting,
                                  const Pose& X_WB) const {
  const Pose X_WL = X_WB * X_BL_;
  const Pose X_WR = X_WB * X_BR();
  const RenderOptions render{.edge_samples_per_pixel = options_.edge_samples_per_pixel};
  AovImages aovs =
      caster.CastAovs(left_->rays, X_WL, lighting, {.offsets_px = {}, .p_WP = X_WR.translation()});
  const cv::Mat1f radiance = caster.Render(left_->rays, X_WL, lighting, render, RandomStream(0));
  cv::Mat2f disparity_px = MatchesOf(aovs.depth_m, cameras_, X_WR.inverse() * X_WL);
  return {.camera = cameras_.left,
          .X_WC = X_WL,
          .aovs = std::move(aovs),
          .band = render.band,
          .radiance = radiance,
          .disparity_px = std::move(disparity_px)};
}

}  // namespace fenestra
