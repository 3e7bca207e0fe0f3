#include "renderers/light/sky_light.h"

#include <cmath>
#include <numbers>

#include "core/geometry/pose.h"
#include "renderers/light/lit_surfaces.h"

namespace fenestra {
namespace {

// The sun's mean apparent radius: 959.6″. Source: Astronomical Almanac.
constexpr double kSunRadius_rad = 959.6 / 3600.0 * kDegree;

}  // namespace

SkyLight::SkyLight(const Lighting& lighting)
    : dome_(lighting.sky.model, lighting.sun.Direction_W()),
      to_sun_W_(lighting.sun.Direction_W()),
      sky_(DaylightSpectrum(lighting.sky.illuminance_lx, lighting)) {
  const double half_sine = std::sin(0.5 * kSunRadius_rad);
  const double solid_angle = 4.0 * std::numbers::pi * half_sine * half_sine;
  disc_ = DaylightSpectrum(SunIlluminance(lighting) / solid_angle, lighting);
}

SkyLight::Seen SkyLight::Towards(const glm::vec3& direction_W) const {
  const Eigen::Vector3d d =
      Eigen::Vector3d(direction_W.x, direction_W.y, direction_W.z).normalized();
  Seen seen{.radiance = static_cast<float>(dome_.LuminancePerLux(d)) * sky_};
  const double chord = 2.0 * std::sin(0.5 * kSunRadius_rad);
  seen.sun = disc_.x > 0.0f && (d - to_sun_W_).squaredNorm() < chord * chord;
  if (seen.sun) seen.radiance += disc_;
  return seen;
}

}  // namespace fenestra
