#include "experiments/cramer_rao/depth_information.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/structured_light/block_evidence.h"
#include "sim/structured_light/disparity.h"

namespace fenestra {
namespace {

constexpr int kStride = 4;

CameraModel InfraredCamera(const StructuredLightOptions& o) {
  return CameraModel::Pinhole(o.depth_width_px, o.depth_height_px, o.depth_focal_px);
}

// Pixels that share a block's noise.
double BlockArea(const StructuredLightOptions& o) {
  const double scale = DisparityRange::kImageWidth / o.depth_width_px;
  const BlockGatherer blocks(o.matching.block_width_px / scale, o.matching.block_height_px / scale,
                             1.0, 1.0);
  return (2.0 * blocks.reach_u() + 1.0) * (2.0 * blocks.reach_v() + 1.0);
}

// The derivative of a disparity by the unknowns. All in the infra-red camera: r the ray, n the
// plane's normal, p a point of it, R_DC the turn from C; height_m: of the plane over the frame's.
struct PlaneRay {
  Eigen::Vector3d r;
  Eigen::Vector3d n;
  Eigen::Vector3d p;
  Eigen::Matrix3d R_DC;
  double height_m;
};

Eigen::Matrix<double, kDepthUnknowns, 1> DisparityGradient(const PlaneRay& at, bool is_wall) {
  const double distance = at.n.dot(at.p);
  const double toward = at.n.dot(at.r);
  // d/(f b) = n·r/(n·p) by n and by p.
  const Eigen::Vector3d by_p = -toward / (distance * distance) * at.n;
  const Eigen::Vector3d by_n = at.r / distance - toward / (distance * distance) * at.p;
  Eigen::Matrix<double, kDepthUnknowns, 1> gradient;
  gradient.setZero();
  gradient.head<3>() = at.R_DC.transpose() * by_p;
  // A turn δ in C moves n by δ x n, and p with it by height_m of that.
  const Eigen::Vector3d by_moved_normal = by_n + at.height_m * by_p;
  gradient.segment<3>(3) = at.R_DC.transpose() * at.n.cross(by_moved_normal);
  if (is_wall) gradient[kWallUnknown] = at.n.dot(by_p);
  return gradient;
}

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
      image_camera_(sensor.nominal().depth),
      rays_(InfraredCamera(options_).Scaled(1.0 / kStride)),
      block_px_(BlockArea(options_)),
      response_(options_.infrared, rays_.camera(), {options_.projector_baseline_m, 0.0, 0.0}),
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
         steps_px2 / options_.averaged_frames;
}

DepthMatrix DepthTheory::Information(const FrameState& frame, double wall_m,
                                     const DepthImage& observed, const RayCaster& caster,
                                     const Lighting& lighting, const Pose& X_WB) const {
  const AovImages aovs =
      caster.CastAovs(rays_, X_WB, lighting, {.offsets_px = {}, .p_WP = X_WB * response_.p_CP()});
  const double exposure = response_.Exposure(aovs);
  // The infra-red camera D is C unless depth is registered to colour.
  const Pose X_DC =
      options_.registered_depth ? Pose::Translation({options_.color_offset_m, 0.0, 0.0}) : Pose();
  const Pose X_CD = X_DC.inverse();
  const Pose X_OC = frame.X_CO.inverse();
  const Eigen::Vector3d n_C = frame.X_CO.rotation().col(2);
  const CameraParameters& k = rays_.camera().parameters();
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
      const Eigen::Matrix<double, kDepthUnknowns, 1> gradient =
          range_.focal_times_baseline *
          DisparityGradient(
              {.r = r,
               .n = X_DC.rotation() * n_C,
               .p = X_DC * Eigen::Vector3d(frame.X_CO.translation() + face->height_m * n_C),
               .R_DC = X_DC.rotation(),
               .height_m = face->height_m},
              face->is_wall);
      information +=
          kStride * kStride / NoiseDensity(light, z_m) * (gradient * gradient.transpose());
    }
  }
  return information;
}

}  // namespace fenestra
