#include "sim/motion/moving_rays.h"

#include "core/io/input_error.h"

namespace fenestra {
namespace {

// Images of consecutive rows, one below the other.
AovImages Stacked(const std::vector<AovImages>& bands) {
  AovImages whole;
  const auto stack = [&](auto field) {
    std::vector<cv::Mat> parts;
    for (const AovImages& band : bands) {
      if (!(band.*field).empty()) parts.push_back(band.*field);
    }
    if (!parts.empty()) cv::vconcat(parts, whole.*field);
  };
  stack(&AovImages::depth_m);
  stack(&AovImages::normal_C);
  stack(&AovImages::object_id);
  stack(&AovImages::material_id);
  stack(&AovImages::sees_sun);
  stack(&AovImages::sees_point);
  stack(&AovImages::transmittance);
  stack(&AovImages::reflectance_830nm);
  stack(&AovImages::irradiance_lx);
  stack(&AovImages::irradiance_830);
  return whole;
}

}  // namespace

MovingRays::MovingRays(const CameraModel& camera, const RollingShutter& shutter)
    : motion_(Validated(shutter).motion), camera_(camera), row_bands_(BandsOf(shutter, camera)) {
  for (const RowBand& band : row_bands_) rays_.emplace_back(RowsOf(camera, band.first, band.count));
}

AovImages MovingRays::CastAovs(const RayCaster& caster, const Pose& X_WB, const Lighting& lighting,
                               const Eigen::Vector3d& p_BP) const {
  std::vector<AovImages> bands;
  for (size_t i = 0; i < rays_.size(); ++i) {
    const Pose X_WC = PoseIn(row_bands_[i], X_WB);
    bands.push_back(
        caster.CastAovs(rays_[i], X_WC, lighting, {.offsets_px = {}, .p_WP = X_WC * p_BP}));
  }
  return bands.size() == 1 ? std::move(bands.front()) : Stacked(bands);
}

}  // namespace fenestra
