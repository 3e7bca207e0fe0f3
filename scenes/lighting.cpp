#include "scenes/lighting.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/faults.h"

namespace fenestra {

Eigen::Vector3d Sun::Direction_W() const {
  return {std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad),
          std::cos(elevation_rad) * std::cos(azimuth_rad)};
}

void Validate(const Lighting& lighting) {
  const Sun& sun = lighting.sun;
  const Sky& sky = lighting.sky;
  Faults faults("lighting");
  const auto finite = [&faults](const char* name, double value) {
    faults.Require(std::isfinite(value), fmt::format("{} must be finite, not {}", name, value));
  };
  finite("sun azimuth_rad", sun.azimuth_rad);
  finite("sun elevation_rad", sun.elevation_rad);
  faults.RequireNotNegative("sun illuminance_lx", sun.illuminance_lx);
  faults.RequireNotNegative("sky illuminance_lx", sky.illuminance_lx);
  faults.RequireWithin("ground_reflectance", sky.ground_reflectance, 0.0, 1.0);
  faults.RequireNotNegative("irradiance_830_per_lux", lighting.irradiance_830_per_lux);
  faults.RequireNotNegative("lamp_dimmer", lighting.lamp_dimmer);
  faults.ThrowIfAny();
}

}  // namespace fenestra
