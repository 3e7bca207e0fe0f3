#include "sim/structured_light/structured_light_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "scenes/facade/facade.h"
#include "scenes/targets/paper_target.h"
#include "sim/motion/rig_pose.h"

namespace fenestra {
namespace {

constexpr double kFocalTimesBaseline = 0.075 * 285.63 * 2.0;  // [px m] at 640 x 480

Scene WhiteWall() {
  PaperTargetOptions options;
  options.with_target = false;
  return MakePaperTarget(options);
}

// A box of the given half width whose front face stands `stand_off_m` before a large wall.
Scene BoxBeforeWall(double half_width_m, double stand_off_m) {
  Scene scene = WhiteWall();
  const float h = static_cast<float>(half_width_m);
  const float z = static_cast<float>(stand_off_m);
  scene.meshes.push_back({.name = "plate",
                          .positions_W = {{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}},
                          .material = scene.meshes.front().material});
  return scene;
}

ExplainedDepth Seen(const StructuredLightOptions& options, const Scene& scene,
                    const Viewpoint& viewpoint, const Lighting& lighting = {}, uint64_t seed = 1) {
  const StructuredLightSensor sensor(options);
  const RayCaster caster(scene);
  return sensor.ObserveDepth(caster, lighting, RigPose(viewpoint, Pose()), RandomStream(seed));
}

StructuredLightOptions Noiseless() {
  StructuredLightOptions options;
  options.parametric.fixed_disparity_noise_px = 0.0;
  options.parametric.temporal_disparity_noise_px = 0.0;
  options.parametric.lateral_noise_px = 0.0;
  return options;
}

TEST(StructuredLightSensorTest, AWallsDepthIsRightToHalfAStep) {
  for (const double z_m : {1.0, 1.7, 2.9, 3.8}) {
    const ExplainedDepth frame = Seen(Noiseless(), WhiteWall(), {.distance_m = z_m});
    const double step_m = 0.125 * z_m * z_m / kFocalTimesBaseline;
    EXPECT_NEAR(frame.depth.raw(120, 160) * frame.depth.unit_m, z_m, 0.5 * step_m * 1.02 + 0.0005);
  }
}

TEST(StructuredLightSensorTest, DepthsAreThoseOfWholeDisparitySteps) {
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

TEST(StructuredLightSensorTest, NoiseOfAWallIsThatOfItsFormula) {
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

TEST(StructuredLightSensorTest, NothingReturnsFromOutsideTheRange) {
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

TEST(StructuredLightSensorTest, TheProjectorsShadowIsLeftOfTheForegroundAndAsWideAsGeometrySays) {
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

TEST(StructuredLightSensorTest, BlackPaintIsLostBetween1And2Metres) {
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

TEST(StructuredLightSensorTest, AmbientLightDrownsTheDots) {
  Lighting sunny;
  sunny.sky.illuminance_lx = 40e3;
  const ExplainedDepth drowned = Seen({}, WhiteWall(), {.distance_m = 2.0}, sunny);
  EXPECT_EQ(cv::countNonZero(drowned.depth.raw), 0);
  Lighting lamps = sunny;
  lamps.irradiance_830_per_lux = 0.0;  // As many lux from LED lamps do no harm.
  EXPECT_GT(cv::countNonZero(Seen({}, WhiteWall(), {.distance_m = 2.0}, lamps).depth.raw), 74000);
}

TEST(StructuredLightSensorTest, AtAFlatAngleNothingReturns) {
  const ExplainedDepth frame =
      Seen({}, WhiteWall(), {.distance_m = 2.0, .azimuth_rad = 80.0 * 3.14159265 / 180.0});
  EXPECT_EQ(static_cast<NoReturn>(frame.no_return(120, 160)), NoReturn::kGrazing);
}

TEST(StructuredLightSensorTest, GlassLetsThePatternThroughToTheRoom) {
  FacadeOptions options;
  options.room.depth_m = 1.0;
  options.room.paint.reflectance_830nm = 0.8;
  const ExplainedDepth frame = Seen(Noiseless(), MakeFacade(options), {.distance_m = 1.5});
  // Centre of the window: the room's back wall at 1.5 + 0.3 + 1.0 m.
  EXPECT_NEAR(frame.depth.raw(120, 160) * 0.001, 2.8, 0.5 * 2.85e-3 * 2.8 * 2.8 + 0.001);
}

TEST(StructuredLightSensorTest, TheColourImagesMeanIsWhatAutomaticExposureAimsFor) {
  const StructuredLightSensor sensor{StructuredLightOptions{}};
  const RayCaster caster(MakePaperTarget({}));
  for (const double lux : {200.0, 500.0, 20000.0}) {
    Lighting lighting;
    lighting.sky.illuminance_lx = lux;
    const RgbdObservation seen =
        sensor.Observe(caster, lighting, RigPose({.distance_m = 1.5}, Pose()), RandomStream(1));
    EXPECT_NEAR(cv::mean(seen.color)[0], 118.0, 2.0) << lux;
  }
}

TEST(StructuredLightSensorTest, RegisteredDepthLiesWhereTheColourCameraSeesIt) {
  StructuredLightOptions options = Noiseless();
  options.registered_depth = true;
  const StructuredLightSensor sensor(options);
  const RayCaster caster(BoxBeforeWall(0.3, 1.0));
  const Pose X_WB = RigPose({.distance_m = 3.0}, Pose());
  const ExplainedDepth frame = sensor.ObserveDepth(caster, {}, X_WB, RandomStream(1));
  const cv::Mat1f truth_m = sensor.PixelTruth(caster, {}, X_WB).aovs.depth_m;
  int wrong = 0;
  int lost = 0;
  for (int v = 20; v < 220; ++v) {
    for (int u = 20; u < 300; ++u) {
      ASSERT_EQ(frame.depth.raw(v, u) == 0, frame.no_return(v, u) != 0);
      if (static_cast<NoReturn>(frame.no_return(v, u)) == NoReturn::kNotRegistered) ++lost;
      if (frame.depth.raw(v, u) == 0) continue;
      if (std::abs(frame.depth.raw(v, u) * 0.001 - static_cast<double>(truth_m(v, u))) > 0.1) {
        ++wrong;
      }
    }
  }
  // Only along the plate's outline, of 2 · 160 + 2 · 160 pixels, windows and rounding err.
  EXPECT_LT(wrong, 700);
  // 25 mm to the right, the colour camera sees more of the wall beside the plate's right edge:
  // 265.6 · 0.025 (1/2 - 1/3) = 1.1 px along its 80 px.
  EXPECT_NEAR(lost, 88.0, 60.0);
  // The plate is where its middle is: 2 m ahead.
  EXPECT_NEAR(frame.depth.raw(120, 160) * 0.001, 2.0, 0.02);
  // The truth is that of the same camera.
  const GroundTruth truth = sensor.Truth(caster.scene(), X_WB);
  EXPECT_TRUE(truth.X_WC == sensor.X_WK(X_WB));
  EXPECT_TRUE(sensor.nominal().X_KD == Pose());
}

TEST(StructuredLightSensorTest, OddPosesNeitherCrashNorInventDepth) {
  StructuredLightOptions options;
  options.depth_width_px = 64;
  options.depth_height_px = 48;
  options.depth_focal_px = 57.0;
  const StructuredLightSensor sensor(options);
  const RayCaster caster(MakeFacade({}));
  const RandomStream stream(9);
  for (uint64_t i = 0; i < 300; ++i) {
    const Eigen::Vector3d axis(stream.Normal(6 * i), stream.Normal(6 * i + 1),
                               stream.Normal(6 * i + 2));
    const Eigen::Vector3d p_WB(3 * stream.Normal(6 * i + 3), 3 * stream.Normal(6 * i + 4),
                               3 * stream.Normal(6 * i + 5));
    const Pose X_WB(RotationFromVector(2.0 * axis), p_WB);
    const ExplainedDepth frame = sensor.ObserveDepth(caster, {}, X_WB, stream.Child("pose", i));
    const AovImages truth = sensor.PixelTruth(caster, {}, X_WB).aovs;
    for (int v = 0; v < 48; ++v) {
      for (int u = 0; u < 64; ++u) {
        const int raw = frame.depth.raw(v, u);
        ASSERT_TRUE(raw == 0 || (raw >= 800 && raw <= 4000));
        ASSERT_EQ(raw == 0, frame.no_return(v, u) != 0);
      }
    }
    if (cv::countNonZero(truth.object_id >= 0) == 0) {
      EXPECT_EQ(cv::countNonZero(frame.depth.raw), 0);
    }
  }
}

}  // namespace
}  // namespace fenestra
