#include "sim/dot_matching.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

// Landau's dot signal was fitted on a white wall.
constexpr double kReferenceReflectance = 0.8;
// 11 % of the area are dots: nine in a window of 9 x 9 (measured on the Kinect's pattern).
constexpr double kDotsPerWindow = 9.0;

// Microsoft Kinect SDK 1.8.
struct Range {
  double nearest_m;
  double farthest_m;
};
constexpr Range kDefaultRange{0.8, 4.0};
constexpr Range kNearRange{0.4, 3.0};

}  // namespace

DotMatching::DotMatching(const StructuredLightOptions& options, const CameraModel& depth)
    : options_(options),
      nearest_m_((options.near_mode ? kNearRange : kDefaultRange).nearest_m),
      farthest_m_((options.near_mode ? kNearRange : kDefaultRange).farthest_m),
      disparity_times_z_(options.projector_baseline_m * depth.parameters().fx_px * kImageWidth /
                         depth.width_px()) {}

DepthReading DotMatching::Read(const LitSurface& surface, const Eigen::Vector3d& ray,
                               double evidence_noise, double disparity_noise) const {
  if (!std::isfinite(surface.z_m)) return {NoReturn::kNoSurface};
  if (surface.z_m < nearest_m_ || surface.z_m > farthest_m_) return {NoReturn::kRange};
  if (!surface.sees_projector) return {NoReturn::kShadow};

  const Eigen::Vector3d p_CQ = surface.z_m * ray;
  const Eigen::Vector3d to_projector =
      Eigen::Vector3d(options_.projector_baseline_m, 0.0, 0.0) - p_CQ;
  const double cos_camera = -surface.normal_C.dot(p_CQ.normalized());
  const double cos_projector = surface.normal_C.dot(to_projector.normalized());
  if (std::min(cos_camera, cos_projector) < std::cos(options_.grazing_limit_rad)) {
    return {NoReturn::kGrazing};
  }
  const NoReturn evidence =
      Evidence(surface, cos_projector, to_projector.squaredNorm(), evidence_noise);
  if (evidence != NoReturn::kNone) return {evidence};

  const double disparity_px =
      disparity_times_z_ / surface.z_m + options_.disparity_noise_px * disparity_noise;
  const double step_px = options_.disparity_step_px;
  const double quantised_px =
      step_px > 0.0 ? step_px * std::round(disparity_px / step_px) : disparity_px;
  const double z_m = disparity_times_z_ / quantised_px;
  if (!(z_m >= nearest_m_ && z_m <= farthest_m_)) return {NoReturn::kRange};
  return {NoReturn::kNone, z_m};
}

NoReturn DotMatching::Evidence(const LitSurface& surface, double cos_projector,
                               double squared_distance_m2, double noise) const {
  const StructuredLightOptions& o = options_;
  const double reflected_dn = o.dot_signal_dn * surface.reflectance_830nm / kReferenceReflectance;
  const double T = surface.transmittance;
  // The pattern passes a pane of glass twice; the irradiance is on the surface, behind the pane.
  const double dot_dn = reflected_dn * cos_projector / squared_distance_m2 * T * T;
  const double ambient_dn =
      reflected_dn * T * (surface.irradiance_830 * o.filter_width_nm / o.dot_irradiance);
  if (ambient_dn >= o.saturation_dn) return NoReturn::kSaturated;
  // A dot may saturate; what counts is how far it stands out of its surroundings.
  const double contrast_dn = std::min(dot_dn, o.saturation_dn - ambient_dn);
  const double noise_dn =
      std::sqrt(o.dark_noise_dn * o.dark_noise_dn + o.shot_noise_dn * (contrast_dn + ambient_dn));
  const double window_snr = std::sqrt(kDotsPerWindow) * contrast_dn / noise_dn;
  return window_snr + noise < o.matching_snr ? NoReturn::kDark : NoReturn::kNone;
}

}  // namespace fenestra
