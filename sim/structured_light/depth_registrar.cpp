#include "sim/structured_light/depth_registrar.h"

#include <cmath>

namespace fenestra {

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
