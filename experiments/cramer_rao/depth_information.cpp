#include "experiments/cramer_rao/depth_information.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/structured_light/block_evidence.h"
#include "sim/structured_light/disparity.h"

namespace fenestra {
namespace {

constexpr int kStride = 4;

// Pixels that share a block's noise.
double BlockArea(const StructuredLightOptions& o) {
  const double scale = DisparityRange::kImageWidth / o.depth_width_px;
  const BlockGatherer blocks(o.matching.block_width_px / scale, o.matching.block_height_px / scale,
                             1.0, 1.0);
  return (2.0 * blocks.reach_u() + 1.0) * (2.0 * blocks.reach_v() + 1.0);
}

// A plane where a ray of the infra-red camera D meets it, all in D: r the ray, n the plane's
// normal, p a point of it. C: the scored camera; height_m: of the plane over the frame.
struct PlaneRay {
  Eigen::Vector3d r;
  Eigen::Vector3d n;
  Eigen::Vector3d p;
  Eigen::Matrix3d R_DC;
  double height_m;
};

using DepthVector = Eigen::Matrix<double, kDepthUnknowns, 1>;

// d/(f b) = n·r/(n·p) by n, by p and by r.
struct PlaneDerivatives {
  Eigen::Vector3d by_n;
  Eigen::Vector3d by_p;
  Eigen::Vector3d by_r;
};
PlaneDerivatives DerivativesAt(const PlaneRay& at) {
  const double distance = at.n.dot(at.p);
  const double toward = at.n.dot(at.r);
  return {.by_n = at.r / distance - toward / (distance * distance) * at.p,
          .by_p = -toward / (distance * distance) * at.n,
          .by_r = at.n / distance};
}

// The derivative of d/(f b) by frame and wall.
DepthVector ByFrame(const PlaneRay& at, const PlaneDerivatives& d, bool is_wall) {
  DepthVector gradient = DepthVector::Zero();
  gradient.head<3>() = at.R_DC.transpose() * d.by_p;
  // A turn δ in C moves n by δ x n, and p with it by height_m of that.
  const Eigen::Vector3d by_moved_normal = d.by_n + at.height_m * d.by_p;
  gradient.segment<3>(3) = at.R_DC.transpose() * at.n.cross(by_moved_normal);
  if (is_wall) gradient[kWallUnknown] = at.n.dot(d.by_p);
  return gradient;
}

// The derivative of d/(f b) by the pose X_CD, R_CD = exp(δ) R and a shift of p_CD: what stands at q
// in C is at R_CDᵀ (q - p_CD) in D.
Eigen::Matrix<double, 6, 1> ByPose(const PlaneRay& at, const PlaneDerivatives& d) {
  const Eigen::Matrix3d R_CD = at.R_DC.transpose();
  Eigen::Matrix<double, 6, 1> gradient;
  // δ moves p in D by R_DC ((q - p_CD) x δ), and n alike.
  gradient.head<3>() = R_CD * d.by_p.cross(at.p) + R_CD * d.by_n.cross(at.n);
  gradient.tail<3>() = -R_CD * d.by_p;
  return gradient;
}

// The derivative of d/(f b) by fx, fy, cx and cy of the infra-red camera.
Eigen::Vector4d ByCamera(const PlaneRay& at, const PlaneDerivatives& d, const CameraParameters& k) {
  return {-at.r.x() / k.fx_px * d.by_r.x(), -at.r.y() / k.fy_px * d.by_r.y(), -d.by_r.x() / k.fx_px,
          -d.by_r.y() / k.fy_px};
}

// The derivative of a disparity by all unknowns.
struct DisparityGradient {
  const CameraModel& infrared;
  double focal_times_baseline;
  bool is_registered;

  DepthVector At(const PlaneRay& at, bool is_wall) const {
    const PlaneDerivatives d = DerivativesAt(at);
    DepthVector gradient = ByFrame(at, d, is_wall);
    const CameraParameters& k = infrared.parameters();
    if (is_registered) gradient.segment<6>(kUnitUnknown + kUnitPose) = ByPose(at, d);
    gradient.segment<4>(kUnitUnknown + kUnitDepthCamera) = ByCamera(at, d, k);
    gradient[kUnitUnknown + kUnitScale] = d.by_r.dot(at.r);
    gradient *= focal_times_baseline;
    gradient[kUnitUnknown + kUnitOffset] = 1.0;
    return gradient;
  }
};

bool Returns(const DepthImage& observed, const CameraModel& camera, const Eigen::Vector3d& p_CQ) {
  const auto pixel = camera.Project(p_CQ);
  if (!pixel || !camera.Contains(*pixel)) return false;
  return observed.raw(static_cast<int>(std::lround(pixel->y())),
                      static_cast<int>(std::lround(pixel->x()))) != 0;
}

// Which of the two planes a point of frame O with this normal lies on, and at which height.
struct Face {
  bool is_wall;
  double height_m;
};
std::optional<Face> FaceOf(const FrameState& frame, double wall_m, const Eigen::Vector3d& p_OQ,
                           const Eigen::Vector3d& normal_O) {
  constexpr double kFlat = 0.999;
  constexpr double kSame_m = 2e-3;
  if (normal_O.z() < kFlat) return std::nullopt;
  const bool within =
      std::abs(p_OQ.x()) <= 0.5 * frame.width_m && std::abs(p_OQ.y()) <= 0.5 * frame.height_m;
  const bool on_border = within && (std::abs(p_OQ.x()) >= 0.5 * frame.width_m - frame.border_m ||
                                    std::abs(p_OQ.y()) >= 0.5 * frame.height_m - frame.border_m);
  if (on_border) {
    return std::abs(p_OQ.z()) < kSame_m ? std::optional(Face{false, 0.0}) : std::nullopt;
  }
  return std::abs(p_OQ.z() - wall_m) < kSame_m ? std::optional(Face{true, wall_m}) : std::nullopt;
}

}  // namespace

DepthTheory::DepthTheory(const StructuredLightSensor& sensor)
    : options_(sensor.options()),
      cameras_(sensor.unit().cameras),
      image_camera_(sensor.cameras().depth),
      rays_(cameras_.depth.Scaled(1.0 / kStride)),
      block_px_(BlockArea(options_)),
      warp_density_(DisparityError::WarpDensity(sensor.unit().deviations.disparity_warp_px) *
                    std::pow(options_.depth_width_px / DisparityRange::kImageWidth, 2)),
      response_(sensor.infrared_response().WithCamera(rays_.camera())),
      range_(RangeOf(options_)) {}

double DepthTheory::NoiseDensity(const InfraredLight& light, double z_m) const {
  const InfraredOptions& infrared = options_.infrared;
  const ParametricDepthOptions& noise = options_.parametric;
  const double ambient_dn = std::min(light.ambient_dn, infrared.saturation_dn);
  const double dot_dn = std::min(light.dot_dn, infrared.saturation_dn - ambient_dn);
  const double variance_dn2 =
      response_.NoiseVariance(response_.pattern_mean() * dot_dn + ambient_dn);
  const double fixed_px2 = noise.fixed_disparity_noise_px * noise.fixed_disparity_noise_px;
  const double flicker_px2 = fixed_px2 * std::pow(response_.FlickerOverFixed(), 2);
  const double temporal_px2 = noise.temporal_disparity_noise_px *
                              noise.temporal_disparity_noise_px * variance_dn2 / (dot_dn * dot_dn);
  const double unit_px = range_.focal_times_baseline / (z_m * z_m) * 1e-3;
  const double steps_px2 = (range_.step_px * range_.step_px + unit_px * unit_px) / 12.0;
  return block_px_ * (fixed_px2 + (flicker_px2 + temporal_px2) / options_.averaged_frames) +
         steps_px2 / options_.averaged_frames + warp_density_;
}

DepthMatrix DepthTheory::Information(const FrameState& frame, double wall_m,
                                     const DepthImage& observed, const RayCaster& caster,
                                     const Lighting& lighting, const Pose& X_WB) const {
  const AovImages aovs =
      caster.CastAovs(rays_, X_WB, lighting, {.offsets_px = {}, .p_WP = X_WB * response_.p_CP()});
  const double exposure = response_.Exposure(aovs);
  // The infra-red camera D is C unless depth is registered to colour.
  const Pose X_DC = options_.registered_depth ? cameras_.X_KD.inverse() : Pose();
  const Pose X_CD = X_DC.inverse();
  const Pose X_OC = frame.X_CO.inverse();
  const Eigen::Vector3d n_C = frame.X_CO.rotation().col(2);
  const CameraParameters& k = rays_.camera().parameters();
  const DisparityGradient gradient{.infrared = cameras_.depth,
                                   .focal_times_baseline = range_.focal_times_baseline,
                                   .is_registered = options_.registered_depth};
  DepthMatrix information = DepthMatrix::Zero();
  for (int v = 0; v < aovs.depth_m.rows; ++v) {
    for (int u = 0; u < aovs.depth_m.cols; ++u) {
      const auto z_m = static_cast<double>(aovs.depth_m(v, u));
      if (!std::isfinite(z_m)) continue;
      const Eigen::Vector3d r((u - k.cx_px) / k.fx_px, (v - k.cy_px) / k.fy_px, 1.0);
      const Eigen::Vector3d p_CQ = X_CD * Eigen::Vector3d(z_m * r);
      const cv::Vec3f& n = aovs.normal_C(v, u);
      const Eigen::Vector3d normal_O =
          X_OC.rotation() * (X_CD.rotation() * Eigen::Vector3d(n[0], n[1], n[2]));
      const auto face = FaceOf(frame, wall_m, X_OC * p_CQ, normal_O);
      if (!face || !Returns(observed, image_camera_, p_CQ)) continue;
      const InfraredLight light = response_.LightAt(aovs, {u, v}, r).At(exposure);
      if (light.dot_dn <= 0.0) continue;
      // Beside bright walls, dark frames return what is the wall's.
      if (!face->is_wall && response_.Correlation(light) < options_.matching.least_correlation) {
        continue;
      }
      const PlaneRay at{
          .r = r,
          .n = X_DC.rotation() * n_C,
          .p = X_DC * Eigen::Vector3d(frame.X_CO.translation() + face->height_m * n_C),
          .R_DC = X_DC.rotation(),
          .height_m = face->height_m};
      information.selfadjointView<Eigen::Lower>().rankUpdate(
          gradient.At(at, face->is_wall), kStride * kStride / NoiseDensity(light, z_m));
    }
  }
  return DepthMatrix(information.selfadjointView<Eigen::Lower>());
}

}  // namespace fenestra
