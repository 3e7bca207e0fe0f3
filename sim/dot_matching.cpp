#include "sim/dot_matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/input_error.h"

namespace fenestra {
namespace {

// 11 % of the area are dots: nine in a window of 9 x 9 (measured on the Kinect's pattern).
constexpr double kDotsPerWindow = 9.0;

}  // namespace

void Validate(const ParametricMatchingOptions& o) {
  std::vector<InputFault> faults;
  const auto demand = [&faults](bool holds, std::string message) {
    if (!holds) faults.push_back({"structured-light sensor", 0, 0, std::move(message)});
  };
  demand(o.disparity_noise_px >= 0.0 && o.lateral_noise_px >= 0.0,
         "disparity noise and lateral noise must not be negative");
  demand(o.window_px >= 1 && o.window_px <= 31,
         fmt::format("matching window {} px is not between 1 and 31", o.window_px));
  demand(o.grazing_limit_rad > 0.0 && o.grazing_limit_rad <= 1.5707,
         "the grazing limit must lie between 0 and 90 degrees");
  if (!faults.empty()) throw InputError(std::move(faults));
}

DotMatching::DotMatching(const ParametricMatchingOptions& options, const InfraredOptions& infrared,
                         const DisparityRange& range)
    : options_(options), infrared_(infrared), range_(range) {}

DepthReading DotMatching::Read(const LitSurface& surface, const Eigen::Vector3d& ray,
                               double evidence_noise, double disparity_noise) const {
  if (!std::isfinite(surface.z_m)) return {NoReturn::kNoSurface};
  if (!range_.Contains(surface.z_m)) return {NoReturn::kRange};
  if (!surface.sees_projector) return {NoReturn::kShadow};
  const double cos_camera = -surface.normal_C.dot(ray.normalized());
  if (std::min(cos_camera, surface.light.cos_projector) < std::cos(options_.grazing_limit_rad)) {
    return {NoReturn::kGrazing};
  }
  const NoReturn evidence = Evidence(surface.light, evidence_noise);
  if (evidence != NoReturn::kNone) return {evidence};
  const double z_m = range_.Depth(range_.focal_times_baseline / surface.z_m +
                                  options_.disparity_noise_px * disparity_noise);
  if (z_m == 0.0) return {NoReturn::kRange};
  return {NoReturn::kNone, z_m};
}

NoReturn DotMatching::Evidence(const InfraredLight& light, double noise) const {
  const InfraredOptions& o = infrared_;
  if (light.ambient_dn >= o.saturation_dn) return NoReturn::kSaturated;
  // A dot may saturate; what counts is how far it stands out of its surroundings.
  const double contrast_dn = std::min(light.dot_dn, o.saturation_dn - light.ambient_dn);
  const double noise_dn = std::sqrt(o.dark_noise_dn * o.dark_noise_dn +
                                    o.shot_noise_dn * (contrast_dn + light.ambient_dn));
  const double window_snr = std::sqrt(kDotsPerWindow) * contrast_dn / noise_dn;
  return window_snr + noise < options_.least_snr ? NoReturn::kDark : NoReturn::kNone;
}

}  // namespace fenestra
