#include "scenes/lighting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/io/faults.h"

namespace fenestra {
namespace {

// The clear sky's integral: a midpoint rule over squared elevation sine and azimuth. The gradation
// is smooth, and so is the sun's aureole over some 20 degrees: 64 x 64 cells are good to 1e-4.
constexpr int kCells = 64;

// A tenth of a radian, ten suns: beyond it a disc is no longer as good as its tangent plane.
constexpr double kMostSun_rad = 0.1;

}  // namespace

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
  faults.RequireWithin("sun angular_diameter_rad", sun.angular_diameter_rad, 0.0, kMostSun_rad);
  faults.RequireNotNegative("sky illuminance_lx", sky.illuminance_lx);
  faults.RequireWithin("ground_reflectance", sky.ground_reflectance, 0.0, 1.0);
  faults.RequireNotNegative("irradiance_830_per_lux", lighting.irradiance_830_per_lux);
  faults.RequireNotNegative("lamp_dimmer", lighting.lamp_dimmer);
  faults.ThrowIfAny();
}

SkyDome::SkyDome(Sky::Model model, const Eigen::Vector3d& to_sun_W)
    : model_(model), to_sun_W_(to_sun_W) {
  constexpr double kPi = std::numbers::pi;
  if (model == Sky::Model::kUniform) {
    scale_ = 1.0 / kPi;
  } else if (model == Sky::Model::kCieOvercast) {
    scale_ = 9.0 / (7.0 * kPi);
  } else {
    double sum = 0.0;
    for (int i = 0; i < kCells; ++i) {
      const double y = std::sqrt((i + 0.5) / kCells);  // sin γ dω is uniform in y² and azimuth.
      for (int j = 0; j < kCells; ++j) {
        const double azimuth = 2.0 * kPi * (j + 0.5) / kCells;
        const double r = std::sqrt(1.0 - y * y);
        sum += Relative({r * std::sin(azimuth), y, r * std::cos(azimuth)});
      }
    }
    scale_ = 1.0 / (kPi * sum / (kCells * kCells));
  }
}

double SkyDome::Relative(const Eigen::Vector3d& direction_W) const {
  const double y = direction_W.y();
  if (model_ == Sky::Model::kUniform) return 1.0;
  if (model_ == Sky::Model::kCieOvercast) return (1.0 + 2.0 * y) / 3.0;
  const double c = std::clamp(direction_W.dot(to_sun_W_), -1.0, 1.0);
  const double gradation = y > 0.0 ? 1.0 - std::exp(-0.32 / y) : 1.0;
  return (0.91 + 10.0 * std::exp(-3.0 * std::acos(c)) + 0.45 * c * c) * gradation;
}

double SkyDome::LuminancePerLux(const Eigen::Vector3d& direction_W) const {
  return scale_ * Relative(direction_W);
}

}  // namespace fenestra
