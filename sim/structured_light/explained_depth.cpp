#include "sim/structured_light/explained_depth.h"

#include <algorithm>
#include <cmath>

namespace fenestra {

NoReturn MissingReturn::Reason(const AovImages& aovs, cv::Point pixel) const {
  if (!std::isfinite(aovs.depth_m(pixel))) return NoReturn::kNoSurface;
  if (!range_.Contains(static_cast<double>(aovs.depth_m(pixel)))) return NoReturn::kRange;
  if (aovs.sees_point(pixel) == 0) return NoReturn::kShadow;
  const InfraredLight light = response_.LightAt(aovs, pixel).At(exposure_);
  if (light.ambient_dn >= response_.options().saturation_dn) return NoReturn::kSaturated;
  if (response_.Correlation(light) < matching_.least_correlation) return NoReturn::kDark;
  constexpr double kGrazingCosine = 0.34;  // 70°: users report holes from 70° to 80°.
  const cv::Vec3f& n = aovs.normal_C(pixel);
  const double cos_camera =
      -Eigen::Vector3d(n[0], n[1], n[2]).dot(response_.RayAt(pixel).normalized());
  return std::min(cos_camera, light.cos_projector) < kGrazingCosine ? NoReturn::kGrazing
                                                                    : NoReturn::kNoMatch;
}

DepthRegistrar::DepthRegistrar(const CameraModel& depth, const Pose& X_KD,
                               const CameraModel& registered)
    : depth_(depth),
      X_DK_(X_KD.inverse()),
      rays_(registered),
      reprojection_(depth, X_KD, registered) {}

ExplainedDepth DepthRegistrar::Register(const ExplainedDepth& depth, const RayCaster& caster,
                                        const Lighting& lighting, const Pose& X_WK) const {
  const DepthReprojection::Reprojected reprojected = reprojection_.Reproject(depth.depth);
  const cv::Mat1f true_m = caster.CastAovs(rays_, X_WK, lighting, {}).depth_m;
  ExplainedDepth result{.depth = {.raw = cv::Mat1w(true_m.size()), .unit_m = depth.depth.unit_m},
                        .no_return = cv::Mat1b(true_m.size()),
                        .infrared = depth.infrared};
  for (int v = 0; v < true_m.rows; ++v) {
    for (int u = 0; u < true_m.cols; ++u) {
      const double z_m = static_cast<double>(reprojected.depth_m(v, u));
      const NoReturn reason = reprojected.source(v, u) == DepthReprojection::kNowhere
                                  ? Reason(depth, {u, v}, true_m(v, u))
                                  : NoReturn::kNone;
      result.depth.raw(v, u) = cv::saturate_cast<uint16_t>(z_m / depth.depth.unit_m);
      result.no_return(v, u) = static_cast<unsigned char>(reason);
    }
  }
  return result;
}

NoReturn DepthRegistrar::Reason(const ExplainedDepth& depth, cv::Point pixel, float z_m) const {
  if (!std::isfinite(z_m)) return NoReturn::kNoSurface;
  const auto ray = rays_.camera().UnprojectRay({pixel.x, pixel.y});
  if (!ray) return NoReturn::kBorder;
  const auto source = depth_.Project(X_DK_ * (static_cast<double>(z_m) * *ray));
  if (!source || !depth_.Contains(*source)) return NoReturn::kBorder;
  const cv::Point nearest(
      std::min(static_cast<int>(std::lround(source->x())), depth_.width_px() - 1),
      std::min(static_cast<int>(std::lround(source->y())), depth_.height_px() - 1));
  const auto reason =
      static_cast<NoReturn>(depth.no_return(std::max(nearest.y, 0), std::max(nearest.x, 0)));
  return reason == NoReturn::kNone ? NoReturn::kNotRegistered : reason;
}

}  // namespace fenestra
