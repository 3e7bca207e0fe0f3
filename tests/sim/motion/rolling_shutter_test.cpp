#include "sim/motion/rolling_shutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/io/input_error.h"
#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra {
namespace {

constexpr double kFocal_px = 285.63;
constexpr double kReadout_s = 0.03;

CameraModel DepthCamera() {
  return CameraModel::Pinhole(320, 240, kFocal_px);
}

RollingShutter Sideways(double speed_m_s, double readout_s) {
  RollingShutter shutter{.motion = {}, .readout_s = readout_s};
  shutter.motion.velocity_B.x() = speed_m_s;
  return shutter;
}

// A wall at z = 0 and a plate one metre before it whose left border is at x = -0.2 m.
Scene PlateBeforeWall() {
  PaperTargetOptions options;
  options.with_target = false;
  Scene scene = MakePaperTarget(options);
  scene.meshes.push_back({.name = "plate",
                          .positions_W = {{-0.2f, -3.0f, 1.0f},
                                          {3.0f, -3.0f, 1.0f},
                                          {3.0f, 3.0f, 1.0f},
                                          {-0.2f, 3.0f, 1.0f}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}},
                          .material = scene.meshes.front().material});
  return scene;
}

// Where a row's depth falls from the wall's to the plate's.
double BorderIn(const cv::Mat1f& depth_m, int row, float between_m) {
  for (int u = 0; u < depth_m.cols; ++u) {
    if (depth_m(row, u) < between_m) return u - 0.5;
  }
  return depth_m.cols;
}

TEST(RollingShutterTest, RowsAreExposedOneAfterTheOtherAroundTheMiddle) {
  const RollingShutter shutter = Sideways(1.0, kReadout_s);
  EXPECT_NEAR(RowTime(shutter, 240, 119.5), 0.0, 1e-15);
  EXPECT_NEAR(RowTime(shutter, 240, 0) + RowTime(shutter, 240, 239), 0.0, 1e-15);
  EXPECT_NEAR(RowTime(shutter, 240, 101) - RowTime(shutter, 240, 100), kReadout_s / 240, 1e-15);
  EXPECT_EQ(RowTime(Sideways(1.0, 0.0), 240, 7), 0.0);
}

TEST(RollingShutterTest, BandsHoldEveryRowOnceAndOneIsEnoughIfNothingMoves) {
  EXPECT_EQ(BandsOf(Sideways(0.0, kReadout_s), DepthCamera()).size(), 1u);
  EXPECT_EQ(BandsOf(Sideways(5.0, 0.0), DepthCamera()).size(), 1u);
  for (const double speed_m_s : {0.05, 0.5, 3.0, 60.0}) {
    const RollingShutter shutter = Sideways(speed_m_s, kReadout_s);
    int next = 0;
    for (const RowBand& band : BandsOf(shutter, DepthCamera())) {
      EXPECT_EQ(band.first, next);
      EXPECT_GE(band.count, 1);
      EXPECT_NEAR(band.t_s, RowTime(shutter, 240, band.first + 0.5 * (band.count - 1)), 1e-15);
      next = band.first + band.count;
    }
    EXPECT_EQ(next, 240);
  }
}

TEST(RollingShutterTest, PicturesOfARowCoverItsExposureEvenly) {
  for (const double readout_s : {0.0, kReadout_s}) {
    for (const double exposure_s : {0.0, 1e-3, 0.02}) {
      if (readout_s + exposure_s == 0.0) continue;
      const RollingShutter shutter = Sideways(2.0, readout_s);
      const std::vector<RowBand> pictures = PicturesOf(shutter, DepthCamera(), exposure_s);
      ASSERT_GE(pictures.size(), 3u);
      const double step_s = (readout_s + exposure_s) / static_cast<double>(pictures.size());
      for (int row = 0; row < 240; ++row) {
        double sum_s = 0.0;
        double first_s = 1.0;
        double last_s = -1.0;
        int count = 0;
        for (const RowBand& picture : pictures) {
          if (row < picture.first || row >= picture.first + picture.count) continue;
          sum_s += picture.t_s;
          first_s = std::min(first_s, picture.t_s);
          last_s = std::max(last_s, picture.t_s);
          ++count;
        }
        ASSERT_GE(count, 1);
        // Pictures stand at whole steps; an exposure begins and ends between two of them.
        EXPECT_NEAR(sum_s / count, RowTime(shutter, 240, row), 0.51 * step_s);
        EXPECT_NEAR(last_s - first_s, std::max(exposure_s - step_s, 0.0), 1.01 * step_s);
      }
    }
  }
}

TEST(RollingShutterTest, AMovingRigSeesUprightBordersSlanted) {
  // At depth z a rig that moves to the right sees a border at u = c + f (x - v t)/z in row v.
  constexpr double kSpeed = 3.0;
  const RayCaster caster(PlateBeforeWall());
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());  // 1 m before the plate.
  const auto border = [&](const RollingShutter& shutter, int row) {
    const AovImages aovs =
        MovingRays(DepthCamera(), shutter).CastAovs(caster, X_WB, {}, {0.075, 0.0, 0.0});
    return BorderIn(aovs.depth_m, row, 1.5f);
  };
  const RollingShutter shutter = Sideways(kSpeed, kReadout_s);
  for (const int row : {0, 60, 119, 180, 239}) {
    const double t_s = RowTime(shutter, 240, row);
    // Half a pixel, to whole pixels, and within a band an eighth.
    EXPECT_NEAR(border(shutter, row), 159.5 + kFocal_px * (-0.2 - kSpeed * t_s), 0.63) << row;
    EXPECT_NEAR(border(Sideways(kSpeed, 0.0), row), 159.5 - kFocal_px * 0.2, 0.5) << row;
  }
}

TEST(RollingShutterTest, DotsOfAMovingRigAreFoundAllTheSame) {
  // The projector moves with the camera: only the surface behind the dots changes.
  StructuredLightOptions options;
  options.depth_model = DepthModel::kMatched;
  options.motion.velocity_B = {1.0, 0.5, 0.0};
  options.motion.angular_velocity_B = {0.0, 0.5, 0.3};
  const StructuredLightSensor sensor(options);
  const RayCaster caster(PlateBeforeWall());
  const ExplainedDepth frame =
      sensor.ObserveDepth(caster, {}, RigPose({.distance_m = 2.5}, Pose()), RandomStream(1));
  const cv::Mat1w plate = frame.depth.raw(cv::Rect(160, 60, 100, 120));
  EXPECT_GT(cv::countNonZero(plate), 11900);
  // 1.5 m; two pixels of yaw at ±15 ms tilt the wall by 0.5 · 0.015 = 7.5 mrad.
  EXPECT_NEAR(cv::mean(plate, plate != 0)[0], 1500.0, 15.0);
}

TEST(RollingShutterTest, AveragedFramesOfAMovingRigLagBehind) {
  StructuredLightOptions options;
  options.quantised = false;
  options.averaged_frames = 3;
  const auto mean_mm = [&](double speed_m_s) {
    options.motion.velocity_B.z() = speed_m_s;
    PaperTargetOptions blank;
    blank.with_target = false;
    const RayCaster caster(MakePaperTarget(blank));
    const ExplainedDepth frame = StructuredLightSensor(options).ObserveDepth(
        caster, {}, RigPose({.distance_m = 2.0}, Pose()), RandomStream(1));
    const cv::Mat1w middle = frame.depth.raw(cv::Rect(80, 60, 160, 120));
    return cv::mean(middle, middle != 0)[0];
  };
  // Frames 0, 33 and 67 ms ago: on average the wall was 33 ms of the way farther off.
  EXPECT_NEAR(mean_mm(1.5) - mean_mm(0.0), 50.0, 1.0);
}

// The sum over columns of the derivative's moments: where a border is, and its variance.
struct Border {
  double mean_px;
  double variance_px2;
};
// Near `around`: farther off the lens darkens the wall.
Border BorderOf(const cv::Mat3b& color, int row, double around_px) {
  const auto light = [&](int u) {
    double sum = 0.0;
    for (int v = row - 2; v <= row + 2; ++v) {
      const double s = color(v, u)[1] / 255.0;
      sum += s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    return sum;
  };
  double sum = 0.0;
  double first = 0.0;
  double second = 0.0;
  const int middle = static_cast<int>(std::lround(around_px));
  for (int u = middle - 12; u < middle + 12; ++u) {
    const double step = light(u + 1) - light(u);
    sum += step;
    first += step * (u + 0.5);
    second += step * (u + 0.5) * (u + 0.5);
  }
  return {first / sum, second / sum - std::pow(first / sum, 2)};
}

TEST(RollingShutterTest, TheColourImageIsSlantedByItsRowsAndBlurredByTheirExposure) {
  constexpr double kSpeed = 1.0;
  constexpr double kExposure_s = 0.01;
  Scene scene = PlateBeforeWall();
  scene.meshes.back().material = static_cast<uint32_t>(scene.materials.size());
  scene.materials.push_back({.name = "black"});
  const RayCaster caster(scene);
  Lighting lighting;
  lighting.sky.illuminance_lx = 300.0;
  const auto see = [&](double speed_m_s, double readout_s, double delay_s = 0.0) {
    StructuredLightOptions options;
    options.motion.velocity_B.x() = speed_m_s;
    options.color_offset_m = 0.0;
    options.color_delay_s = delay_s;
    options.color.distortion = {};
    options.color.readout_s = readout_s;
    options.color.auto_exposure = false;
    options.color.exposure_s = kExposure_s;
    options.color.electrons_per_lux_s = 1e4;
    options.color.sensor.noise = false;
    options.color.sensor.fixed_pattern = false;
    return StructuredLightSensor(options)
        .Observe(caster, lighting, RigPose({.distance_m = 2.0}, Pose()), RandomStream(1))
        .color;
  };
  const double f_px = StructuredLightOptions{}.color.focal_px;
  const double border_px = 319.5 - 0.2 * f_px;
  const cv::Mat3b unmoved = see(0.0, kReadout_s);
  const Border still = BorderOf(unmoved, 240, border_px);
  const Border moving = BorderOf(see(kSpeed, 0.0), 240, border_px);
  // An even smear of length f v T / z has a twelfth of its square as variance. Eight bits.
  EXPECT_NEAR(std::sqrt(12.0 * (moving.variance_px2 - still.variance_px2)),
              f_px * kSpeed * kExposure_s, 0.3);
  EXPECT_NEAR(moving.mean_px, still.mean_px, 0.1);
  constexpr double kDelay_s = 8e-3;
  const double late_px = border_px - f_px * kSpeed * kDelay_s;
  EXPECT_NEAR(BorderOf(see(kSpeed, 0.0, kDelay_s), 240, late_px).mean_px - still.mean_px,
              -f_px * kSpeed * kDelay_s, 0.1);
  const cv::Mat3b rolling = see(kSpeed, kReadout_s);
  for (const int row : {20, 240, 460}) {
    const double t_s = RowTime(Sideways(kSpeed, kReadout_s), 480, row);
    const double shift_px = -f_px * kSpeed * t_s;
    EXPECT_NEAR(BorderOf(rolling, row, border_px + shift_px).mean_px -
                    BorderOf(unmoved, row, border_px).mean_px,
                shift_px, 0.3)
        << row;
  }
}

TEST(RollingShutterTest, ImpossibleTimesAreRefused) {
  StructuredLightOptions options;
  options.infrared_readout_s = -0.01;
  EXPECT_THROW(StructuredLightSensor{options}, InputError);
  options.infrared_readout_s = 0.03;
  options.color.readout_s = NAN;
  EXPECT_THROW(StructuredLightSensor{options}, InputError);
}

}  // namespace
}  // namespace fenestra
