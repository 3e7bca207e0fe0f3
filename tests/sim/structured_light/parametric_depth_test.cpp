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

ExplainedDepth Seen(const StructuredLightOptions& options, const Scene& scene,
                    const Viewpoint& viewpoint, const Lighting& lighting = {}, uint64_t seed = 1) {
  const StructuredLightSensor sensor(options);
  const RayCaster caster(scene);
  return sensor.ObserveDepth(caster, lighting, RigPose(viewpoint, Pose()), RandomStream(seed));
}

TEST(ParametricDepthTest, AWallsDepthIsRightToHalfAStep) {
  for (const double z_m : {1.0, 1.7, 2.9, 3.8}) {
    const ExplainedDepth frame = Seen(Noiseless(), WhiteWall(), {.distance_m = z_m});
    const double step_m = 0.125 * z_m * z_m / kFocalTimesBaseline;
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
    const double steps = kFocalTimesBaseline / (raw * 0.001) / 0.125;
    // Rounding to whole millimetres moves it by z² shift: 0.0005 m · f b / z² / step.
    EXPECT_NEAR(steps, std::round(steps),
                0.0005 * kFocalTimesBaseline / std::pow(raw * 0.001, 2) / 0.125 + 1e-6);
  }
}

TEST(ParametricDepthTest, NoiseOfAWallIsThatOfItsFormula) {
  // σ_z = z²/(f b) σ_d, and σ_d² = fixed² + (temporal σ/s)² + step²/12. The window correlates
  // neighbours, so that about 320 · 240 / 25 = 3000 independent samples remain: relative standard
  // deviation 1.3 %; the band of 8 % holds six of them. Depth is rounded to 1 mm, which adds 0.29
  // mm.
  const StructuredLightOptions options;
  const ParametricDepthOptions& noise = options.parametric;
  for (const double z_m : {1.5, 2.0, 3.0, 3.6}) {
    // A tilt of one degree runs through many quantisation steps.
    const ExplainedDepth frame = Seen({}, WhiteWall(), {.distance_m = z_m, .azimuth_rad = 0.0175});
    const CameraModel camera = CameraModel::Pinhole(320, 240, 285.63);
    double sum2 = 0.0;
    int count = 0;
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) {
        if (frame.depth.raw(v, u) == 0) continue;
        const Eigen::Vector3d ray = *camera.UnprojectRay({u, v});
        // The wall's plane: n p = n (0, 0, z) with n = (-sin a, 0, -cos a) seen from azimuth a.
        const double true_m =
            z_m * std::cos(0.0175) / (std::cos(0.0175) + std::sin(0.0175) * ray.x());
        const double error_m = frame.depth.raw(v, u) * 0.001 - true_m;
        // Inverse square and cosine; the projector is taken to be where the camera is. A pixel gets
        // a fifth of a dot's peak on average.
        const double dot_dn = 590.0 / (true_m * true_m * std::pow(ray.squaredNorm(), 1.5));
        const double snr = dot_dn / std::sqrt(10.4 * 10.4 + 0.5 * 0.206 * dot_dn);
        const double sigma_px =
            std::sqrt(std::pow(noise.fixed_disparity_noise_px, 2) +
                      std::pow(noise.temporal_disparity_noise_px / snr, 2) + 0.125 * 0.125 / 12.0);
        const double sigma_m =
            std::hypot(true_m * true_m / kFocalTimesBaseline * sigma_px, 0.00029);
        sum2 += std::pow(error_m / sigma_m, 2);
        ++count;
      }
    }
    EXPECT_NEAR(std::sqrt(sum2 / count), 1.0, 0.08) << z_m;
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
    // Windows of noise correlate by 0.5 at one of 134 places with 134 Φ(-4.5) = 5e-4.
    EXPECT_LT(cv::countNonZero(raw), 1e-3 * static_cast<double>(raw.total())) << distance_m;
  };
  for (const double distance_m : {0.3, 0.7, 4.2, 8.0}) expect_nothing(false, distance_m);
  for (const double distance_m : {0.35, 3.2}) expect_nothing(true, distance_m);
  StructuredLightOptions near;
  near.near_mode = true;
  EXPECT_GT(cv::countNonZero(Seen(near, WhiteWall(), {.distance_m = 0.6}).depth.raw), 70000);
}

TEST(ParametricDepthTest, TheProjectorsShadowIsLeftOfTheForegroundAndAsWideAsGeometrySays) {
  // Plate at 2 m, wall at 3 m: f b (1/2 - 1/3) = 7.14 px at 640, half of it at 320 px.
  const ExplainedDepth frame = Seen(Noiseless(), BoxBeforeWall(0.3, 1.0), {.distance_m = 3.0});
  int first = -1;
  int last = -1;
  for (int u = 0; u < 320; ++u) {
    if (frame.no_return(120, u) != static_cast<int>(NoReturn::kShadow)) continue;
    if (first < 0) first = u;
    last = u;
  }
  ASSERT_GE(first, 0);
  const double expected_px = 0.5 * kFocalTimesBaseline * (1.0 / 2.0 - 1.0 / 3.0);
  EXPECT_NEAR(last - first + 1, expected_px, 1.0);  // Whole pixels.
  // The plate's left edge is at -0.3 m: 159.5 - 285.63 · 0.15 = 116.7 px.
  EXPECT_EQ(last, 116);
}

TEST(ParametricDepthTest, BlackPaintIsLostBetween1And2Metres) {
  // A pattern of variance 0.080 and dots of 590 (0.05/0.8)/z² DN in noise of 10.5 DN correlate with
  // 1/√(1 + (10.5 z²/(√0.080 · 36.9))²), which is 1/2 at z = 1.31 m.
  const auto returned = [](double distance_m, double reflectance) {
    PaperTargetOptions options;
    options.wall_reflectance_830nm = reflectance;
    options.with_target = false;
    const ExplainedDepth frame = Seen({}, MakePaperTarget(options), {.distance_m = distance_m});
    // Near the axis: towards the corners obliquity and distance cost half of the light.
    return cv::countNonZero(frame.depth.raw(cv::Rect(120, 90, 80, 60))) / 4800.0;
  };
  EXPECT_GT(returned(1.1, 0.05), 0.9);
  EXPECT_NEAR(returned(1.31, 0.05), 0.5, 0.3);
  EXPECT_LT(returned(1.9, 0.05), 0.1);
  EXPECT_GT(returned(2.7, 0.40), 0.95);
}

TEST(ParametricDepthTest, AmbientLightDrownsTheDots) {
  Lighting sunny;
  sunny.sky.illuminance_lx = 40e3;
  const ExplainedDepth drowned = Seen({}, WhiteWall(), {.distance_m = 2.0}, sunny);
  EXPECT_EQ(cv::countNonZero(drowned.depth.raw), 0);
  Lighting lamps = sunny;
  lamps.irradiance_830_per_lux = 0.0;  // As many lux from LED lamps do no harm.
  EXPECT_GT(cv::countNonZero(Seen({}, WhiteWall(), {.distance_m = 2.0}, lamps).depth.raw), 74000);
}

TEST(ParametricDepthTest, AtAFlatAngleNothingReturns) {
  const ExplainedDepth frame =
      Seen({}, WhiteWall(), {.distance_m = 2.0, .azimuth_rad = 80.0 * 3.14159265 / 180.0});
  EXPECT_EQ(static_cast<NoReturn>(frame.no_return(120, 160)), NoReturn::kGrazing);
}

TEST(ParametricDepthTest, GlassLetsThePatternThroughToTheRoom) {
  FacadeOptions options;
  options.room.depth_m = 1.0;
  options.room.paint.reflectance_830nm = 0.8;
  const ExplainedDepth frame = Seen(Noiseless(), MakeFacade(options), {.distance_m = 1.5});
  // Centre of the window: the room's back wall at 1.5 + 0.3 + 1.0 m.
  EXPECT_NEAR(frame.depth.raw(120, 160) * 0.001, 2.8, 0.5 * 2.85e-3 * 2.8 * 2.8 + 0.001);
}

}  // namespace
}  // namespace fenestra
