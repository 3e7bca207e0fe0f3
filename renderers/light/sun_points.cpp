#include "renderers/light/sun_points.h"

#include <cmath>
#include <numbers>

#include "renderers/tracing/sobol_samples.h"

namespace fenestra {
namespace {

// Twice i in the field of sixteen elements, x⁴ + x + 1 = 0. Like i itself, 2 i and 2 i + i take
// each value once.
constexpr int Doubled(int i) {
  return (i << 1 & 0xf) ^ ((i & 8) != 0 ? 3 : 0);
}

}  // namespace

SunPoints::SunPoints(const Sun& sun) : is_point_(sun.angular_diameter_rad == 0.0) {
  const Eigen::Vector3d to_sun = sun.Direction_W();
  const Eigen::Vector3d right = to_sun.unitOrthogonal();
  const Eigen::Vector3d up = to_sun.cross(right);
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  const double radius = std::tan(0.5 * sun.angular_diameter_rad);
  const auto set = [&](int j, int i, double r, double phi) {
    const Eigen::Vector3f d =
        (to_sun + r * (std::cos(phi) * right + std::sin(phi) * up)).normalized().cast<float>();
    Directions& turn = turns_W_[static_cast<size_t>(j)];
    turn.x[i] = d.x();
    turn.y[i] = d.y();
    turn.z[i] = d.z();
  };
  for (int i = 0; i < kLanes; ++i) {
    for (int j = 0; j < kTurns; ++j) {
      const SobolPoint point = NthSobolPoint(static_cast<uint32_t>(kTurns * i + (Doubled(i) ^ j)));
      // The middles of 256 strata.
      const double u = point.x * 0x1p-32 + 0x1p-9;
      const double v = point.y * 0x1p-32 + 0x1p-9;
      set(j, i, radius * std::sqrt(u), kTwoPi * v);
    }
    // Five is odd, so that all sixteenths occur, and those of neighbours are far apart.
    set(kRim, i, radius, kTwoPi * 5.0 * i / kLanes);
  }
}

void SunPoints::Aim(const Choice& choice, RTCRay16& rays) const {
  const Directions& turn = turns_W_[static_cast<size_t>(choice.turn)];
  for (int i = 0; i < kLanes; ++i) {
    const int lane = i ^ choice.shift;
    rays.dir_x[i] = turn.x[lane];
    rays.dir_y[i] = turn.y[lane];
    rays.dir_z[i] = turn.z[lane];
  }
}

}  // namespace fenestra
