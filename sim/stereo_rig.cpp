#include "sim/stereo_rig.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/input_error.h"

namespace fenestra {
namespace {

// Presumes positive lengths.
CameraModel NominalCamera(const StereoRigOptions& options) {
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

Pose NominalLeft(double baseline_m) {
  return Pose::Translation({-0.5 * baseline_m, 0.0, 0.0});
}
Pose NominalRight(double baseline_m) {
  return Pose::Translation({0.5 * baseline_m, 0.0, 0.0});
}

Eigen::Vector3d NormalVector(const RandomStream& stream, double sigma) {
  return sigma * Eigen::Vector3d(stream.Normal(0), stream.Normal(1), stream.Normal(2));
}

// Where the left image's surface points are in the right one, as differences of their pixels.
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

cv::Mat1b Quantise(const cv::Mat1f& signal) {
  cv::Mat1b dn;
  signal.convertTo(dn, CV_8U, 255.0);  // Rounds to nearest.
  return dn;
}

}  // namespace

void Validate(const StereoRigOptions& o) {
  std::vector<InputFault> faults;
  const auto demand = [&faults](bool holds, std::string message) {
    if (!holds) faults.push_back({"stereo rig", 0, 0, std::move(message)});
  };
  demand(o.pixel_pitch_m > 0.0, fmt::format("pixel pitch {} m is not positive", o.pixel_pitch_m));
  demand(o.focal_length_m > 0.0,
         fmt::format("focal length {} m is not positive", o.focal_length_m));
  demand(o.baseline_m > 0.0, fmt::format("baseline {} m is not positive", o.baseline_m));
  demand(o.lens.f_number > 0.0, fmt::format("f-number {} is not positive", o.lens.f_number));
  demand(o.exposure.shortest_s <= o.exposure.longest_s,
         fmt::format("shortest exposure {} s is longer than the longest, {} s",
                     o.exposure.shortest_s, o.exposure.longest_s));
  demand(o.rotation_tolerance_rad >= 0.0 && o.translation_tolerance_m >= 0.0,
         "tolerances must not be negative");
  if (faults.empty() && !DistortionIsInvertible(NominalCamera(o))) {
    demand(false, "the distortion folds the image over before its corners");
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

StereoRig::StereoRig(const StereoRigOptions& options)
    : options_((Validate(options), options)),
      nominal_{
          .left = NominalCamera(options),
          .right = NominalCamera(options),
          .X_RL = NominalRight(options.baseline_m).inverse() * NominalLeft(options.baseline_m)},
      rays_(nominal_.left),
      vignetting_(NaturalVignetting(rays_)) {}

StereoRig::TrueState StereoRig::Nominal() const {
  return {.X_BL = NominalLeft(options_.baseline_m), .X_BR = NominalRight(options_.baseline_m)};
}

StereoRig::TrueState StereoRig::Draw(const RandomStream& rig) const {
  const Eigen::Vector3d rotation =
      NormalVector(rig.Child("right_rotation"), options_.rotation_tolerance_rad);
  const Eigen::Vector3d translation =
      NormalVector(rig.Child("right_translation"), options_.translation_tolerance_m);
  const Pose displacement(RotationFromVector(rotation), translation);
  return {.X_BL = NominalLeft(options_.baseline_m),
          .X_BR = NominalRight(options_.baseline_m) * displacement};
}

StereoObservation StereoRig::Observe(const RayCaster& caster, const Lighting& lighting,
                                     const Pose& X_WB, const TrueState& state,
                                     const RandomStream& shot) const {
  const RenderOptions render{.band = Band::kLuminance,
                             .samples_per_pixel = 4,
                             .edge_samples_per_pixel = options_.edge_samples_per_pixel};
  const auto luminance = [&](const Pose& X_BC, const RandomStream& sampling) {
    const cv::Mat1f image = caster.Render(rays_, X_WB * X_BC, lighting, render, sampling);
    return cv::Mat1f(image.mul(vignetting_));
  };
  const cv::Mat1f left = luminance(state.X_BL, shot.Child("left_sampling"));
  const cv::Mat1f right = luminance(state.X_BR, shot.Child("right_sampling"));

  // One exposure for both cameras, from the left one, as a hardware-synchronised pair has it.
  const double exposure_s =
      ChooseExposure(options_.exposure, options_.sensor, options_.lens, cv::mean(left)[0]);
  const auto expose = [&](const cv::Mat1f& image, const RandomStream& noise) {
    const cv::Mat1f blurred = BlurByLens(image, options_.lens);
    return Quantise(Expose(blurred, options_.sensor, options_.lens, exposure_s, noise));
  };
  return {.left = expose(left, shot.Child("left_noise")),
          .right = expose(right, shot.Child("right_noise"))};
}

GroundTruth StereoRig::Truth(const Scene& scene, const Pose& X_WB, const TrueState& state) const {
  const Pose X_WL = X_WB * state.X_BL;
  const std::array<PlacedCamera, 2> cameras = {PlacedCamera{nominal_.left, X_WL},
                                               PlacedCamera{nominal_.right, X_WB * state.X_BR}};
  return MakeGroundTruth(scene, X_WL, cameras);
}

TruthImages StereoRig::LeftTruth(const RayCaster& caster, const Lighting& lighting,
                                 const Pose& X_WB, const TrueState& state) const {
  const Pose X_WL = X_WB * state.X_BL;
  const Pose X_WR = X_WB * state.X_BR;
  const RenderOptions render{.edge_samples_per_pixel = options_.edge_samples_per_pixel};
  AovImages aovs =
      caster.CastAovs(rays_, X_WL, lighting, {.offsets_px = {}, .p_WP = X_WR.translation()});
  const cv::Mat1f radiance = caster.Render(rays_, X_WL, lighting, render, RandomStream(0));
  cv::Mat2f disparity_px = MatchesOf(aovs.depth_m, nominal_, X_WR.inverse() * X_WL);
  return {.camera = nominal_.left,
          .X_WC = X_WL,
          .aovs = std::move(aovs),
          .band = render.band,
          .radiance = radiance,
          .disparity_px = std::move(disparity_px)};
}

}  // namespace fenestra
