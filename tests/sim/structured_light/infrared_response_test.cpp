#include "sim/structured_light/infrared_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random/random_stream.h"
#include "sim/motion/rig_pose.h"
#include "sim/structured_light/structured_light_sensor.h"
#include "tests/sim/structured_light/wall_scenes.h"

namespace fenestra {
namespace {

TEST(GammaVariateTest, HasTheMomentsAndTheSkewOfAGammaDistribution) {
  constexpr size_t kCount = 400'000;
  std::vector<float> normals(kCount);
  RandomStream(4).FillNormals(normals);
  for (const double c : {0.0, 0.21, 0.42, 0.47}) {
    const GammaVariate gamma(c);
    double sum = 0.0, sum2 = 0.0, sum3 = 0.0;
    for (const float normal : normals) {
      const double off = static_cast<double>(gamma(normal)) - 1.0;
      sum += off;
      sum2 += off * off;
      sum3 += off * off * off;
    }
    // Standard errors: c/√n, c/√2n and √6/n, below a third of these bounds.
    EXPECT_NEAR(sum / kCount, 0.0, 0.003) << c;
    EXPECT_NEAR(std::sqrt(sum2 / kCount), c, 0.01 * c + 1e-6) << c;
    // The third central moment of a gamma distribution is 2 c⁴.
    EXPECT_NEAR(sum3 / kCount, 2.0 * c * c * c * c, 0.1 * c * c * c + 1e-9) << c;
  }
}

// The camera and what it sees of a wall across its axis.
struct Wall {
  explicit Wall(double z_m, double sky_lx = 1.0) {
    const RayCaster caster(testing::WhiteWall());
    Lighting lighting;
    lighting.sky.illuminance_lx = sky_lx;
    const StructuredLightSensor sensor({});
    aovs = sensor.PixelTruth(caster, lighting, RigPose({.distance_m = z_m}, Pose())).aovs;
  }
  InfraredResponse response{{}, StructuredLightSensor({}).nominal().depth, {0.075, 0.0, 0.0}};
  AovImages aovs;
};

TEST(InfraredResponseTest, DotsFallOffWithTheSquareOfTheDistanceAndToTheCorners) {
  const Wall near(1.0);
  const Wall far(2.0);
  const double middle = near.response.LightAt(near.aovs, {160, 120}).dot_dn;
  // 75 mm beside the camera: by 0.3 % at 1 m.
  EXPECT_NEAR(middle, 590.0 * 0.8 / 0.8, 4.0);
  EXPECT_NEAR(middle / far.response.LightAt(far.aovs, {160, 120}).dot_dn, 4.0, 0.02);
  // tan α = 0.70: cos⁴ α of the angles of incidence and of the lens over one cos α.
  const double corner = far.response.LightAt(far.aovs, {2, 2}).dot_dn;
  const double cosine = 1.0 / std::sqrt(1.0 + 0.49);
  EXPECT_NEAR(corner / far.response.LightAt(far.aovs, {160, 120}).dot_dn, std::pow(cosine, 4) * 0.7,
              0.02);
}

TEST(InfraredResponseTest, ThePatternHasTheProjectorsPower) {
  const Wall wall(1.0);
  // A plane at 1 m across the axis, of the field of view: 640 · 480 / 571.26² m².
  const double area_m2 = 640.0 * 480.0 / (571.26 * 571.26);
  EXPECT_NEAR(wall.response.DotIrradiance() * wall.response.pattern_mean() * area_m2, 0.060, 1e-9);
  EXPECT_NEAR(wall.response.DotIrradiance(), 0.309, 0.002);
}

TEST(InfraredResponseTest, TheExposureKeepsOutOfSaturation) {
  const Wall dim(2.0);
  EXPECT_EQ(dim.response.Exposure(dim.aovs), 1.0);
  const Wall bright(2.0, 50e3);
  const double exposure = bright.response.Exposure(bright.aovs);
  EXPECT_LT(exposure, 0.5);
  const InfraredLight light = bright.response.LightAt(bright.aovs, {160, 120}).At(exposure);
  EXPECT_LT(light.dot_dn + light.ambient_dn, 1023.0);
  EXPECT_GT(light.dot_dn + light.ambient_dn, 500.0);
}

TEST(InfraredResponseTest, CorrelationFallsWithLightAndIsLimitedBySpeckle) {
  const Wall wall(1.0);
  double before = 1.0;
  for (const double dot_dn : {1000.0, 100.0, 10.0, 3.0, 1.0}) {
    const double now = wall.response.Correlation({.dot_dn = dot_dn});
    EXPECT_LT(now, before);
    EXPECT_GT(now, wall.response.Correlation({.dot_dn = dot_dn, .ambient_dn = 100.0}));
    before = now;
  }
  const double v = wall.response.pattern_variance();
  const double m = wall.response.pattern_mean();
  EXPECT_NEAR(wall.response.Correlation({.dot_dn = 1e6}),
              std::sqrt(v / (v + wall.response.SpeckleVariance() * (v + m * m))), 1e-3);
}

}  // namespace
}  // namespace fenestra
