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

}  // namespace
}  // namespace fenestra
