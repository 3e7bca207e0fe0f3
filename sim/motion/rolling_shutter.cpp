#include "sim/motion/rolling_shutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

constexpr double kNearest_m = 0.5;

double MotionIn(const RollingShutter& shutter, const CameraModel& camera, double t_s) {
  const CameraParameters& k = camera.parameters();
  const double x = std::max(k.cx_px + 0.5, k.width_px - 0.5 - k.cx_px) / k.fx_px;
  const double y = std::max(k.cy_px + 0.5, k.height_px - 0.5 - k.cy_px) / k.fy_px;
  return ImageMotion(shutter.motion, t_s, std::max(k.fx_px, k.fy_px), std::hypot(x, y), kNearest_m);
}

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

void Validate(const RollingShutter& shutter) {
  // Written so that NaN fails.
  if (shutter.readout_s >= 0.0 && shutter.readout_s <= 1.0) return;
  throw InputError("rolling shutter",
                   fmt::format("reading out takes 0 to 1 s, not {}", shutter.readout_s));
}

double RowTime(const RollingShutter& shutter, int height_px, double row) {
  return shutter.readout_s * ((row + 0.5) / height_px - 0.5);
}

std::vector<RowBand> BandsOf(const RollingShutter& shutter, const CameraModel& camera) {
  constexpr double kStep_px = 0.25;
  const int height = camera.height_px();
  const double steps = std::ceil(MotionIn(shutter, camera, shutter.readout_s) / kStep_px);
  const int count = static_cast<int>(std::clamp(steps, 1.0, static_cast<double>(height)));
  std::vector<RowBand> bands;
  for (int i = 0; i < count; ++i) {
    const int first = height * i / count;
    const int rows = height * (i + 1) / count - first;
    bands.push_back({first, rows, RowTime(shutter, height, first + 0.5 * (rows - 1))});
  }
  return bands;
}

std::vector<RowBand> PicturesOf(const RollingShutter& shutter, const CameraModel& camera,
                                double exposure_s) {
  constexpr double kStep_px = 0.5;
  constexpr double kMostPictures = 64.0;
  const int height = camera.height_px();
  const double whole_s = shutter.readout_s + exposure_s;
  const double motion_px = MotionIn(shutter, camera, whole_s);
  const int count =
      static_cast<int>(std::clamp(std::ceil(motion_px / kStep_px), 1.0, kMostPictures));
  if (count == 1) return {{0, height, 0.0}};
  // Row v counts pictures within half an exposure of t(v); at least the nearest one.
  const double reach_s = 0.5 * std::max(exposure_s, whole_s / count);
  const auto rows_before = [&](double t_s) {  // How many rows have t(v) < t.
    if (shutter.readout_s == 0.0) return t_s > 0.0 ? height : 0;
    const double row = (t_s / shutter.readout_s + 0.5) * height - 0.5;
    return static_cast<int>(std::clamp(std::ceil(row), 0.0, static_cast<double>(height)));
  };
  std::vector<RowBand> pictures;
  for (int i = 0; i < count; ++i) {
    const double t_s = whole_s * ((i + 0.5) / count - 0.5);
    const int first = rows_before(t_s - reach_s);
    const int end = rows_before(t_s + reach_s);
    if (end > first) pictures.push_back({first, end - first, t_s});
  }
  return pictures;
}

CameraModel RowsOf(const CameraModel& camera, int first, int count) {
  CameraParameters k = camera.parameters();
  k.height_px = count;
  k.cy_px -= first;
  return CameraModel(k);
}

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
