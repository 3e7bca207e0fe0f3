#include "renderers/light/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/pose.h"

namespace fenestra {
namespace {

constexpr int kBands = 8;
constexpr std::array<int, kBands> kPatchesOfBand = {30, 30, 24, 24, 18, 12, 6, 1};
constexpr double kBandHeight_rad = 12.0 * std::numbers::pi / 180.0;
// Luminance is averaged over this many points along each side of a patch.
constexpr int kPointsPerSide = 6;

// Sines of the elevations between which a band lies.
double LowSine(int band) {
  return std::sin(band * kBandHeight_rad);
}
double HighSine(int band) {
  return band + 1 == kBands ? 1.0 : LowSine(band + 1);
}

}  // namespace

SkyLight::SkyLight(const Lighting& lighting)
    : dome_(lighting.sky.model, lighting.sun.Direction_W()),
      to_sun_W_(lighting.sun.Direction_W()),
      sky_(DaylightSpectrum(lighting.sky.illuminance_lx, lighting)),
      chord_(2.0 * std::sin(0.25 * lighting.sun.angular_diameter_rad)) {
  const double half_sine = std::sin(0.25 * lighting.sun.angular_diameter_rad);
  if (half_sine > 0.0) {
    const double solid_angle = 4.0 * std::numbers::pi * half_sine * half_sine;
    disc_ = DaylightSpectrum(SunIlluminance(lighting) / solid_angle, lighting);
  }
}

SkyLight::Seen SkyLight::Towards(const glm::vec3& direction_W) const {
  const Eigen::Vector3d d =
      Eigen::Vector3d(direction_W.x, direction_W.y, direction_W.z).normalized();
  Seen seen{.radiance = static_cast<float>(dome_.LuminancePerLux(d)) * sky_};
  seen.sun = disc_.x > 0.0f && (d - to_sun_W_).squaredNorm() < chord_ * chord_;
  if (seen.sun) seen.radiance += disc_;
  return seen;
}

int SkyPatchOf(const glm::vec3& direction_W) {
  const double elevation = std::asin(std::clamp(static_cast<double>(direction_W.y), 0.0, 1.0));
  const int band = std::min(static_cast<int>(elevation / kBandHeight_rad), kBands - 1);
  int first = 0;
  for (int b = 0; b < band; ++b) first += kPatchesOfBand[static_cast<size_t>(b)];
  const int count = kPatchesOfBand[static_cast<size_t>(band)];
  const double azimuth =
      std::atan2(static_cast<double>(direction_W.x), static_cast<double>(direction_W.z));
  const int i = static_cast<int>((azimuth / (2.0 * std::numbers::pi) + 0.5) * count);
  return first + std::clamp(i, 0, count - 1);
}

namespace {

// Directions at equal solid angles over patch i of `count` in a band.
template <typename Function>
void ForEachDirection(int band, int i, int count, const Function& f) {
  for (int p = 0; p < kPointsPerSide; ++p) {
    // Solid angle is uniform in the sine of the elevation.
    const double y = std::lerp(LowSine(band), HighSine(band), (p + 0.5) / kPointsPerSide);
    const double r = std::sqrt(1.0 - y * y);
    for (int q = 0; q < kPointsPerSide; ++q) {
      const double azimuth =
          2.0 * std::numbers::pi * ((i + (q + 0.5) / kPointsPerSide) / count - 0.5);
      f(Eigen::Vector3d(r * std::sin(azimuth), y, r * std::cos(azimuth)));
    }
  }
}

}  // namespace

std::array<PatchLuminance, kSkyPatches> PatchLuminances(const SkyDome& dome) {
  constexpr double kPart = 1.0 / (kPointsPerSide * kPointsPerSide);
  std::array<PatchLuminance, kSkyPatches> patches;
  size_t next = 0;
  for (int band = 0; band < kBands; ++band) {
    const int count = kPatchesOfBand[static_cast<size_t>(band)];
    for (int i = 0; i < count; ++i) {
      PatchLuminance& patch = patches[next++];
      ForEachDirection(band, i, count, [&](const Eigen::Vector3d& d) {
        patch.mean += kPart * dome.LuminancePerLux(d);
        patch.centre += kPart * d;
      });
      // Regression on the coordinates along two tangents, which are uncorrelated by symmetry.
      const Eigen::Vector3d out = patch.centre.normalized();
      const Eigen::Vector3d level =
          band + 1 == kBands ? Eigen::Vector3d::UnitX()
                             : Eigen::Vector3d(Eigen::Vector3d::UnitY().cross(out).normalized());
      for (const Eigen::Vector3d& tangent : {level, Eigen::Vector3d(out.cross(level))}) {
        double covariance = 0.0;
        double variance = 0.0;
        ForEachDirection(band, i, count, [&](const Eigen::Vector3d& d) {
          const double along = tangent.dot(d - patch.centre);
          covariance += along * (dome.LuminancePerLux(d) - patch.mean);
          variance += along * along;
        });
        patch.gradient += covariance / variance * tangent;
      }
    }
  }
  return patches;
}

}  // namespace fenestra
