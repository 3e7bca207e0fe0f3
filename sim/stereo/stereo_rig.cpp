#include "sim/stereo/stereo_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

Pose DesignedLeft(double baseline_m) {
  return Pose::Translation({-0.5 * baseline_m, 0.0, 0.0});
}
Pose DesignedRight(double baseline_m) {
  return Pose::Translation({0.5 * baseline_m, 0.0, 0.0});
}

// The displacement of a camera from its place in the design.
Pose Mounting(const StereoRigOptions& options, const RandomStream& camera) {
  if (options.as_designed) return Pose();
  const RigTolerances& tolerances = options.tolerances;
  return RandomPose(camera, tolerances.rotation_rad, tolerances.translation_m);
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

ExposedView ViewOf(const StereoCamera& camera, const cv::Mat1f& electrons_per_s,
                   const ExposureSetting& exposure, const PointSpread& spread) {
  return {.exposure = exposure,
          .sensor = camera.sensor().options(),
          .spread = spread,
          .electrons = electrons_per_s * exposure.exposure_s};
}

// The distance of the nearest thing seen [m].
double NearestOf(const cv::Mat1f& inverse_distances) {
  double most = 0.0;
  cv::minMaxLoc(inverse_distances, nullptr, &most);
  constexpr double kFar_m = 1e4;
  return 1.0 / std::max(most, 1.0 / kFar_m);
}

}  // namespace

StereoRig::StereoRig(const StereoRigOptions& options, const RandomStream& rig)
    : options_(Validated(options)),
      X_BL_(DesignedLeft(options.baseline_m) * Mounting(options, rig.Child("left"))),
      pattern_key_(rig.key()),
      left_(std::make_shared<const StereoCamera>(options, rig.Child("left"))),
      right_(std::make_shared<const StereoCamera>(options, rig.Child("right"))),
      cameras_{.left = left_->model(),
               .right = right_->model(),
               .X_RL = (DesignedRight(options.baseline_m) * Mounting(options, rig.Child("right")))
                           .inverse() *
                       X_BL_} {}

StereoRig StereoRig::Displaced(const Pose& X_RRnew) const {
  StereoRig displaced = *this;
  displaced.cameras_.X_RL = X_RRnew.inverse() * cameras_.X_RL;
  return displaced;
}

StereoRig StereoRig::Still() const {
  StereoRig still = *this;
  still.options_.motion = {};
  still.options_.hover = {.speed_m_s = 0.0, .turn_rad_s = 0.0};
  still.options_.trigger_skew_s = 0.0;
  return still;
}

StereoRig StereoRig::WithNoise() const {
  if (options_.sensor.noise && options_.sensor.fixed_pattern) return *this;
  StereoRig noisy = *this;
  noisy.options_.sensor.noise = true;
  noisy.options_.sensor.fixed_pattern = true;
  for (std::shared_ptr<const StereoCamera>* side : {&noisy.left_, &noisy.right_}) {
    *side = std::make_shared<const StereoCamera>((*side)->With(noisy.options_.sensor));
  }
  return noisy;
}

RigMotion StereoRig::MotionDuring(const RandomStream& shot) const {
  return WithHover(options_.motion, options_.hover, shot.Child("hover"));
}

QuarterImages StereoRig::Light(const StereoCamera& camera, const Pose& X_BC,
                               const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                               const RigMotion& motion, double nearest_m, double t_s,
                               double exposure_s, const RandomStream& sampling) const {
  const RenderOptions render{.band = Band::kLuminance,
                             .samples_per_pixel = 4,
                             .edge_samples_per_pixel = options_.edge_samples_per_pixel};
  // Pictures a pixel apart at the fastest: the pixel's own area joins them up. One will do for a
  // smear whose variance, 0.005 px², is small beside a pixel's.
  constexpr double kStill_px = 0.25;
  constexpr double kStep_px = 1.0;
  constexpr double kMostPictures = 64.0;
  const double motion_px = ImageMotion(motion, exposure_s, camera.model().parameters().fx_px,
                                       LargestRadius(camera.rays()), nearest_m);
  const int pictures =
      motion_px <= kStill_px
          ? 1
          : std::max(2, static_cast<int>(std::ceil(std::min(motion_px / kStep_px, kMostPictures))));
  // The middles of n equal parts have 1 - 1/n² of the variance of the whole.
  const double spread = pictures > 1 ? pictures / std::sqrt(pictures * pictures - 1.0) : 1.0;
  QuarterImages sum;
  for (int i = 0; i < pictures; ++i) {
    const double middle_s = t_s + spread * ((i + 0.5) / pictures - 0.5) * exposure_s;
    const Pose X_WC = PoseAt(X_WB, motion, middle_s) * X_BC;
    QuarterImages picture = caster.RenderQuarters(
        camera.rays(), X_WC, lighting, render, sampling.Child("picture", static_cast<uint64_t>(i)));
    if (pictures == 1) return picture;
    for (size_t q = 0; q < sum.size(); ++q) {
      const cv::Mat share = picture[q] / pictures;
      sum[q] = i == 0 ? share : cv::Mat(sum[q] + share);
    }
  }
  return sum;
}

StereoObservation StereoRig::Develop(const QuarterImages& left, const QuarterImages& right,
                                     const RandomStream& shot) const {
  const cv::Mat1f left_e_s = left_->ElectronsPerSecond(left, left_->SpreadInFocus());
  const cv::Mat1f right_e_s = right_->ElectronsPerSecond(right, right_->SpreadInFocus());
  const ExposureSetting of_left = left_->ExposureFor(cv::mean(left_e_s)[0]);
  const ExposureSetting of_right =
      options_.own_exposure ? right_->ExposureFor(cv::mean(right_e_s)[0]) : of_left;
  return {.left = left_->Image(left_e_s, of_left, shot.Child("left_noise")),
          .right = right_->Image(right_e_s, of_right, shot.Child("right_noise"))};
}

StereoObservation StereoRig::Observe(const RayCaster& caster, const Lighting& lighting,
                                     const Pose& X_WB, const RandomStream& shot) const {
  return Shoot(caster, lighting, X_WB, shot).observation;
}

StereoShot StereoRig::Shoot(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                            const RandomStream& shot) const {
  const RandomStream left_sampling = shot.Child("left_sampling");
  const RandomStream right_sampling = shot.Child("right_sampling");
  const RigMotion motion = MotionDuring(shot);
  const Pose X_WL = X_WB * X_BL_;
  const Pose X_WR = X_WB * X_BR();
  const ExposureSetting of_left =
      left_->ExposureAt(X_WL, caster, lighting, left_sampling.Child("metering"));
  const ExposureSetting of_right =
      options_.own_exposure
          ? right_->ExposureAt(X_WR, caster, lighting, right_sampling.Child("metering"))
          : of_left;
  const double right_middle_s =
      options_.trigger_skew_s + 0.5 * (of_right.exposure_s - of_left.exposure_s);
  const cv::Mat1f left_inverse = left_->InverseDistances(X_WL, caster);
  const cv::Mat1f right_inverse = right_->InverseDistances(X_WR, caster);
  const PointSpread left_spread = left_->SpreadAt(left_inverse);
  const PointSpread right_spread = right_->SpreadAt(right_inverse);
  const cv::Mat1f left = left_->ElectronsPerSecond(
      Light(*left_, X_BL_, caster, lighting, X_WB, motion, NearestOf(left_inverse), 0.0,
            of_left.exposure_s, left_sampling),
      left_spread);
  const cv::Mat1f right = right_->ElectronsPerSecond(
      Light(*right_, X_BR(), caster, lighting, X_WB, motion, NearestOf(right_inverse),
            right_middle_s, of_right.exposure_s, right_sampling),
      right_spread);
  return {.observation = {.left = left_->Image(left, of_left, shot.Child("left_noise")),
                          .right = right_->Image(right, of_right, shot.Child("right_noise"))},
          .left = ViewOf(*left_, left, of_left, left_spread),
          .right = ViewOf(*right_, right, of_right, right_spread)};
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
  AovImages aovs = caster.CastAovs(left_->rays(), X_WL, lighting,
                                   {.offsets_px = {}, .p_WP = X_WR.translation()});
  const cv::Mat1f radiance = caster.Render(left_->rays(), X_WL, lighting, render, RandomStream(0));
  cv::Mat2f disparity_px = MatchesOf(aovs.depth_m, cameras_, X_WR.inverse() * X_WL);
  return {.camera = cameras_.left,
          .X_WC = X_WL,
          .aovs = std::move(aovs),
          .band = render.band,
          .radiance = radiance,
          .disparity_px = std::move(disparity_px)};
}

}  // namespace fenestra
