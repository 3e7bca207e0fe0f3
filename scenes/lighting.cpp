#include "scenes/lighting.h"

#include <fmt/format.h>

#include <cmath>

#include "core/input_error.h"

namespace fenestra {

Eigen::Vector3d Sun::Direction_W() const {
  return {std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad),
          std::cos(elevation_rad) * std::cos(azimuth_rad)};
}

void Validate(const Lighting& lighting) {
  std::vector<InputFault> faults;
  const auto demand = [&faults](const char* name, double value, bool allowed, const char* range) {
    if (allowed && std::isfinite(value)) return;
    faults.push_back({"lighting", 0, 0, fmt::format("{} must be {}, not {}", name, range, value)});
  };
  const Sun& sun = lighting.sun;
  const Sky& sky = lighting.sky;
  demand("sun azimuth_rad", sun.azimuth_rad, true, "finite");
  demand("sun elevation_rad", sun.elevation_rad, true, "finite");
  demand("sun illuminance_lx", sun.illuminance_lx, sun.illuminance_lx >= 0.0, "0 or more");
  demand("sky illuminance_lx", sky.illuminance_lx, sky.illuminance_lx >= 0.0, "0 or more");
  demand("ground_reflectance", sky.ground_reflectance,
         sky.ground_reflectance >= 0.0 && sky.ground_reflectance <= 1.0, "in [0, 1]");
  demand("irradiance_830_per_lux", lighting.irradiance_830_per_lux,
         lighting.irradiance_830_per_lux >= 0.0, "0 or more");
  demand("lamp_dimmer", lighting.lamp_dimmer, lighting.lamp_dimmer >= 0.0, "0 or more");
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace fenestra
