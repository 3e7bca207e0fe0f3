#include "sim/structured_light/missing_return.h"

#include <algorithm>
#include <cmath>

namespace fenestra {

NoReturn MissingReturn::Reason(const AovImages& aovs, cv::Point pixel) const {
  if (!range_.Contains(aovs.depth_m(pixel))) return NoReturn::kRange;
  if (aovs.sees_point(pixel) == 0) return NoReturn::kShadow;
  const CameraParameters& k = camera_.parameters();
  const Eigen::Vector3d ray((pixel.x - k.cx_px) / k.fx_px, (pixel.y - k.cy_px) / k.fy_px, 1.0);
  const InfraredLight light = InfraredLightAt(infrared_, aovs, pixel, ray, p_CP_);
  if (light.ambient_dn >= infrared_.saturation_dn) return NoReturn::kSaturated;
  // A block that just correlates enough: its noise is √(1/ρ² - 1) times the pattern's contrast,
  // which is a third of a dot's peak.
  constexpr double kContrast = 1.0 / 3.0;
  const double noise_dn =
      std::sqrt(infrared_.dark_noise_dn * infrared_.dark_noise_dn +
                infrared_.shot_noise_dn * (light.ambient_dn + kContrast * light.dot_dn));
  const double rho = matching_.least_correlation;
  if (kContrast * light.dot_dn < noise_dn / std::sqrt(1.0 / (rho * rho) - 1.0)) {
    return NoReturn::kDark;
  }
  constexpr double kGrazingCosine = 0.34;  // 70°: users report holes from 70° to 80°.
  const cv::Vec3f& n = aovs.normal_C(pixel);
  const double cos_camera = -Eigen::Vector3d(n[0], n[1], n[2]).dot(ray.normalized());
  return std::min(cos_camera, light.cos_projector) < kGrazingCosine ? NoReturn::kGrazing
                                                                    : NoReturn::kNoMatch;
}

}  // namespace fenestra
