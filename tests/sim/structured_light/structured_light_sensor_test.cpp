#include "sim/structured_light/structured_light_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/facade/facade.h"
#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"
#include "tests/sim/structured_light/wall_scenes.h"

namespace fenestra {
namespace {

using testing::BoxBeforeWall;
using testing::Noiseless;

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
  options.color_offset_m = 0.1;
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
  // 0.1 m to the right, the colour camera sees more of the wall beside the plate's right edge:
  // 265.6 · 0.1 (1/2 - 1/3) = 4.4 px along its 80 px, to within a pixel of the outline.
  EXPECT_NEAR(lost / 80.0, 4.4, 1.0);
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
      // Blocks of noise match by chance, one in 300.
      EXPECT_LT(cv::countNonZero(frame.depth.raw), 40);
    }
  }
}

}  // namespace
}  // namespace fenestra
