#include "scenes/lighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

TEST(Sun, AtZeroStandsOnTheFacadesNormal) {
  const Sun sun{.azimuth_rad = 0.0, .elevation_rad = 0.0};
  EXPECT_EQ(sun.Direction_W(), Eigen::Vector3d(0.0, 0.0, 1.0));
}

TEST(Sun, AzimuthTurnsTowardsPlusXAndElevationTowardsPlusY) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  const Sun beside{.azimuth_rad = kQuarter, .elevation_rad = 0.0};
  const Sun above{.azimuth_rad = 0.3, .elevation_rad = kQuarter};
  // cos(π/2) in doubles is 6e-17.
  EXPECT_LT((beside.Direction_W() - Eigen::Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((above.Direction_W() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

TEST(Lighting, AllFaultsAreReportedAtOnce) {
  Lighting lighting;
  lighting.sun.illuminance_lx = -1.0;
  lighting.sun.azimuth_rad = std::numeric_limits<double>::infinity();
  lighting.sky.ground_reflectance = 1.5;
  try {
    Validate(lighting);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3u) << error.what();
  }
  EXPECT_NO_THROW(Validate(Lighting{}));
}

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d Towards(double azimuth_rad, double elevation_rad) {
  return Sun{.azimuth_rad = azimuth_rad, .elevation_rad = elevation_rad}.Direction_W();
}

// Illuminance of a plane with the normal n by the dome alone: a midpoint rule much finer than the
// one that normalises the clear sky, and of another kind.
double Illuminance(const SkyDome& dome, const Eigen::Vector3d& n) {
  constexpr int kElevations = 400;
  constexpr int kAzimuths = 800;
  double E = 0.0;
  for (int i = 0; i < kElevations; ++i) {
    const double elevation = 0.5 * kPi * (i + 0.5) / kElevations;
    for (int j = 0; j < kAzimuths; ++j) {
      const Eigen::Vector3d d = Towards(2.0 * kPi * (j + 0.5) / kAzimuths, elevation);
      const double solid_angle =
          std::cos(elevation) * (0.5 * kPi / kElevations) * (2.0 * kPi / kAzimuths);
      E += dome.LuminancePerLux(d) * std::max(n.dot(d), 0.0) * solid_angle;
    }
  }
  return E;
}

TEST(SkyDome, GivesAHorizontalPlaneOneLux) {
  for (const Sky::Model model :
       {Sky::Model::kUniform, Sky::Model::kCieOvercast, Sky::Model::kCieClear}) {
    for (const double elevation : {0.1, 0.7, 1.5}) {
      const SkyDome dome(model, Towards(0.4, elevation));
      EXPECT_NEAR(Illuminance(dome, Eigen::Vector3d::UnitY()), 1.0, 1e-3);
    }
  }
}

TEST(SkyDome, OvercastIsThreeTimesAsBrightAtTheZenithAndGivesAFacadeTwoFifths) {
  const SkyDome dome(Sky::Model::kCieOvercast, Eigen::Vector3d::UnitY());
  EXPECT_NEAR(
      dome.LuminancePerLux(Towards(0.3, 0.5 * kPi)) / dome.LuminancePerLux(Towards(1.0, 1e-12)),
      3.0, 1e-9);
  // E_v/E_h = ∫ (1 + 2 sin γ) cos² γ dγ / ∫ (1 + 2 sin γ) π sin γ cos γ dγ · 2, over 0 to π/2.
  EXPECT_NEAR(Illuminance(dome, Eigen::Vector3d::UnitZ()), 3.0 / 7.0 * (0.5 + 4.0 / (3.0 * kPi)),
              1e-3);
}

TEST(SkyDome, ClearIsBrightestTowardsTheSun) {
  const Eigen::Vector3d to_sun = Towards(0.5, 0.6);
  const SkyDome dome(Sky::Model::kCieClear, to_sun);
  const double at_sun = dome.LuminancePerLux(to_sun);
  for (double azimuth = 0.0; azimuth < 6.0; azimuth += 0.5) {
    for (const double elevation : {0.2, 0.6, 1.2}) {
      EXPECT_LE(dome.LuminancePerLux(Towards(azimuth, elevation)), at_sun);
    }
  }
  // A quarter of the sky away it is dark blue, not black: the ratio from the formula.
  EXPECT_GT(at_sun / dome.LuminancePerLux(Towards(0.5 + kPi, 0.6)), 8.0);
}

}  // namespace
}  // namespace fenestra
