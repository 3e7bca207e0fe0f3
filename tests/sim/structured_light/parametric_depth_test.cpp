#include "sim/structured_light/parametric_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "scenes/facade/facade.h"
#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"
#include "sim/structured_light/structured_light_sensor.h"
#include "tests/sim/structured_light/wall_scenes.h"

namespace fenestra {
namespace {

using testing::BoxBeforeWall;
using testing::Noiseless;
using testing::WhiteWall;

constexpr double kFocalTimesBaseline = 0.075 * 285.63 * 2.0;  // [px m] at 640 x 480
constexpr double kStep_px = 0.0625;                           // Of Microsoft's driver.

ExplainedDepth Seen(const StructuredLightOptions& options, const Scene& scene,
                    const Viewpoint& viewpoint, const Lighting& lighting = {}, uint64_t seed = 1) {
  const StructuredLightSensor sensor(options);
  const RayCaster caster(scene);
  return sensor.ObserveDepth(caster, lighting, RigPose(viewpoint, Pose()), RandomStream(seed));
}

TEST(ParametricDepthTest, AWallsDepthIsRightToHalfAStep) {
  for (const double z_m : {1.0, 1.7, 2.9, 3.8}) {
    const ExplainedDepth frame = Seen(Noiseless(), WhiteWall(), {.distance_m = z_m});
    const double step_m = kStep_px * z_m * z_m / kFocalTimesBaseline;
    EXPECT_NEAR(frame.depth.raw(120, 160) * frame.depth.unit_m, z_m, 0.5 * step_m * 1.02 + 0.0005);
  }
}

TEST(ParametricDepthTest, DepthsAreThoseOfWholeDisparitySteps) {
  const ExplainedDepth frame = Seen({}, WhiteWall(), {.distance_m = 2.0, .azimuth_rad = 0.5});
  std::set<uint16_t> values;
  for (const uint16_t raw : frame.depth.raw) {
    if (raw != 0) values.insert(raw);
  }
  ASSERT_GT(values.size(), 20u);
  for (const uint16_t raw : values) {
    const double steps = kFocalTimesBaseline / (raw * 0.001) / kStep_px;
    // Rounding to whole millimetres moves it by z² shift: 0.0005 m · f b / z² / step.
    EXPECT_NEAR(steps, std::round(steps),
                0.0005 * kFocalTimesBaseline / std::pow(raw * 0.001, 2) / kStep_px + 1e-6);
  }
}

TEST(ParametricDepthTest, NoiseOfAWallIsThatOfItsFormula) {
  // σ_z = z²/(f b) σ_d, and σ_d² = fixed² (1 + flicker²/contrast²) + (temporal σ/s)² + step²/12. The
  // window correlates neighbours, so that 3000 independent samples remain: a relative standard
  // deviation of 1.3 %. The disparity's place within a pixel, over which the constants are means,
  // makes up to 12 %. Depth is rounded to 1 mm, which adds 0.29 mm.
  const StructuredLightOptions options;
  const ParametricDepthOptions& noise = options.parametric;
  const InfraredOptions& infrared = options.infrared;
  const CameraModel camera = CameraModel::Pinhole(320, 240, 285.63);
  for (const double z_m : {1.5, 2.0, 3.0, 3.6}) {
    // A tilt of one degree runs through many quantisation steps.
    const ExplainedDepth frame = Seen({}, WhiteWall(), {.distance_m = z_m, .azimuth_rad = 0.0175});
    double sum2 = 0.0;
    int count = 0;
    for (int v = 60; v < 180; ++v) {
      for (int u = 80; u < 240; ++u) {
        if (frame.depth.raw(v, u) == 0) continue;
        const Eigen::Vector3d ray = *camera.UnprojectRay({u, v});
        // The wall's plane: n p = n (0, 0, z) with n = (-sin a, 0, -cos a) seen from azimuth a.
        const double true_m =
            z_m * std::cos(0.0175) / (std::cos(0.0175) + std::sin(0.0175) * ray.x());
        const double error_m = frame.depth.raw(v, u) * 0.001 - true_m;
        // The projector is taken to be where the camera is. A pixel gets a fifth of a dot's peak on
        // average.
        const double dot_dn =
            infrared.dot_signal_dn / (true_m * true_m) / std::pow(ray.squaredNorm(), 2);
        const double snr = dot_dn / std::sqrt(std::pow(infrared.dark_noise_dn, 2) +
                                              infrared.shot_noise_dn * 0.206 * dot_dn);
        const double flicker = infrared.speckle_flicker / infrared.speckle_contrast;
        const double sigma_px = std::sqrt(
            std::pow(noise.fixed_disparity_noise_px, 2) * (1.0 + flicker * flicker) +
            std::pow(noise.temporal_disparity_noise_px / snr, 2) + kStep_px * kStep_px / 12.0);
        const double sigma_m =
            std::hypot(true_m * true_m / kFocalTimesBaseline * sigma_px, 0.00029);
        sum2 += std::pow(error_m / sigma_m, 2);
        ++count;
      }
    }
    EXPECT_NEAR(std::sqrt(sum2 / count), 1.0, 0.15) << z_m;
  }
}

TEST(ParametricDepthTest, NothingReturnsFromOutsideTheRange) {
  const auto expect_nothing = [](bool near_mode, double distance_m) {
    StructuredLightOptions options;
    options.near_mode = near_mode;
    const cv::Mat1w raw = Seen(options, WhiteWall(), {.distance_m = distance_m}).depth.raw;
    for (const uint16_t z_mm : raw) {
      if (z_mm == 0) continue;
      EXPECT_GE(z_mm, near_mode ? 400 : 800);
      EXPECT_LE(z_mm, near_mode ? 3000 : 4000);
    }
    // Windows of noise correlate by 0.45 at one of 134 places with 134 Φ(-4.05) = 3.4e-3.
    EXPECT_LT(cv::countNonZero(raw), 6e-3 * static_cast<double>(raw.total())) << distance_m;
  };
  for (const double distance_m : {0.3, 0.7, 4.2, 8.0}) expect_nothing(false, distance_m);
  for (const double distance_m : {0.35, 3.2}) expect_nothing(true, distance_m);
  StructuredLightOptions near;
  near.near_mode = true;
  EXPECT_GT(cv::countNonZero(Seen(near, WhiteWall(), {.distance_m = 0.6}).depth.raw), 70000);
}

TEST(ParametricDepthTest, TheProjectorsShadowIsLeftOfTheForeground) {
  // Plate at 1.5 m, wall at 3 m: f b (1/1.5 - 1/3) = 14.3 px at 640, half of it at 320 px, less
  // what the plate's blocks fill.
  const ExplainedDepth frame = Seen(Noiseless(), BoxBeforeWall(0.3, 1.5), {.distance_m = 3.0});
  const double geometry_px = 0.5 * kFocalTimesBaseline * (1.0 / 1.5 - 1.0 / 3.0);
  int holes = 0;
  for (int v = 100; v < 140; ++v) {
    for (int u = 0; u < 320; ++u) {
      if (static_cast<NoReturn>(frame.no_return(v, u)) == NoReturn::kShadow) {
        ++holes;
        // The plate's left edge is at 159.5 - 285.63 · 0.2 = 102.4 px.
        EXPECT_NEAR(u, 102.4 - 0.5 * geometry_px, 0.5 * geometry_px + 1.0);
      }
    }
  }
  EXPECT_NEAR(holes / 40.0, geometry_px - 1.75, 1.25);
}

TEST(ParametricDepthTest, AmbientLightDrownsTheDotsOfFarWallsFirst) {
  Lighting sunny;
  sunny.sky.illuminance_lx = 100e3;
  const auto valid = [](const Lighting& lighting, double distance_m) {
    const cv::Mat1w raw = Seen({}, WhiteWall(), {.distance_m = distance_m}, lighting).depth.raw;
    return cv::countNonZero(raw) / static_cast<double>(raw.total());
  };
  EXPECT_GT(valid(sunny, 1.0), 0.8);
  EXPECT_LT(valid(sunny, 3.5), 0.1);
  Lighting lamps = sunny;
  lamps.irradiance_830_per_lux = 0.0;  // As many lux from LED lamps do no harm.
  EXPECT_GT(valid(lamps, 3.5), 0.9);
}

TEST(ParametricDepthTest, AtAFlatAngleNothingReturns) {
  // A block holds the wall from 1.6 to 2.7 m.
  const ExplainedDepth frame =
      Seen({}, WhiteWall(), {.distance_m = 2.0, .azimuth_rad = 86.0 * 3.14159265 / 180.0});
  EXPECT_NE(static_cast<NoReturn>(frame.no_return(120, 160)), NoReturn::kNone);
}

TEST(ParametricDepthTest, GlassLetsThePatternThroughToTheRoom) {
  FacadeOptions options;
  options.room.depth_m = 1.0;
  options.room.paint.reflectance_830nm = 0.8;
  const ExplainedDepth frame = Seen(Noiseless(), MakeFacade(options), {.distance_m = 1.5});
  // Centre of the window: the room's back wall at 1.5 + 0.3 + 1.0 m.
  EXPECT_NEAR(frame.depth.raw(120, 160) * 0.001, 2.8, 0.5 * 1.46e-3 * 2.8 * 2.8 + 0.001);
}

}  // namespace
}  // namespace fenestra
