// The structured-light sensor that matches its dots in an infra-red image.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "scenes/facade/facade.h"
#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"
#include "sim/structured_light/structured_light_sensor.h"
#include "tests/sim/structured_light/depth_poses.h"

namespace fenestra {
namespace {

StructuredLightOptions Speckle() {
  StructuredLightOptions options;
  options.depth_model = DepthModel::kMatched;
  return options;
}

Scene PlainWall() {
  PaperTargetOptions options;
  options.with_target = false;
  return MakePaperTarget(options);
}

Lighting Dark() {
  Lighting lighting;
  lighting.sky.illuminance_lx = 1.0;
  return lighting;
}

ExplainedDepth SeenByMatching(const StructuredLightOptions& options, const Scene& scene,
                              const Viewpoint& viewpoint, const Lighting& lighting = Dark(),
                              uint64_t seed = 1) {
  const StructuredLightSensor sensor(options);
  const RayCaster caster(scene);
  return sensor.ObserveDepth(caster, lighting, RigPose(viewpoint, Pose()), RandomStream(seed));
}

// Share of pixels with a return, of those in the middle half of the image.
double ValidShare(const ExplainedDepth& frame) {
  const cv::Size size = frame.depth.raw.size();
  const cv::Rect middle(size.width / 4, size.height / 4, size.width / 2, size.height / 2);
  return cv::countNonZero(frame.depth.raw(middle)) / static_cast<double>(middle.area());
}

// RMS of depth around the plane that fits the image's middle best [m].
double PlaneResidual(const ExplainedDepth& frame) {
  const int width = frame.depth.raw.cols;
  const int height = frame.depth.raw.rows;
  std::vector<Eigen::Vector3d> rows;
  std::vector<double> inverse;
  for (int v = height / 4; v < 3 * height / 4; ++v) {
    for (int u = width / 4; u < 3 * width / 4; ++u) {
      if (frame.depth.raw(v, u) == 0) continue;
      // A plane's inverse depth is linear in the image.
      rows.emplace_back(u, v, 1.0);
      inverse.push_back(1.0 / (frame.depth.raw(v, u) * frame.depth.unit_m));
    }
  }
  Eigen::MatrixXd matrix(static_cast<int>(rows.size()), 3);
  Eigen::VectorXd values(static_cast<int>(rows.size()));
  for (int i = 0; i < values.size(); ++i) {
    matrix.row(i) = rows[static_cast<size_t>(i)];
    values[i] = inverse[static_cast<size_t>(i)];
  }
  const Eigen::VectorXd plane = matrix.colPivHouseholderQr().solve(values);
  double sum = 0.0;
  for (int i = 0; i < values.size(); ++i) {
    sum += std::pow(1.0 / values[i] - 1.0 / matrix.row(i).dot(plane), 2);
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(MatchedDepthTest, AWallIsWhereItStands) {
  for (const double z_m : {0.9, 1.5, 2.5, 3.5}) {
    const ExplainedDepth frame = SeenByMatching(Speckle(), PlainWall(), {.distance_m = z_m});
    EXPECT_GT(ValidShare(frame), 0.99) << z_m;
    const cv::Rect middle(140, 100, 40, 40);
    const double mean_m = cv::mean(frame.depth.raw(middle))[0] * frame.depth.unit_m;
    // The parabola through half-pixel steps is wrong by up to a tenth of a pixel.
    EXPECT_NEAR(mean_m, z_m, 0.1 * z_m * z_m / (2.0 * 285.63 * 0.075)) << z_m;
  }
}

TEST(MatchedDepthTest, NoiseOfAWallGrowsWithTheSquareOfTheDistance) {
  // σ = (1.3–1.75)e-3 z² m, noise, fixed pattern and quantisation in 1/8 px together, of walls in
  // some 2,500 recorded frames of eight devices from 0.7 to 7.5 m. Nothing here was fitted to it.
  StructuredLightOptions options = Speckle();
  options.driver = DepthDriver::kOpenNi;
  for (const double z_m : {1.0, 2.0, 3.0, 5.0, 7.0}) {
    const ExplainedDepth frame =
        SeenByMatching(options, PlainWall(), {.distance_m = z_m, .azimuth_rad = 0.03});
    const double over_z2 = PlaneResidual(frame) / (z_m * z_m);
    EXPECT_GT(over_z2, 1.2e-3) << z_m;
    EXPECT_LT(over_z2, 1.9e-3) << z_m;
  }
}

TEST(MatchedDepthTest, DepthsComeInStepsOfTheDisparity) {
  for (const auto& [driver, step_px] :
       {std::pair{DepthDriver::kOpenNi, 0.125}, {DepthDriver::kMicrosoft, 0.0625}}) {
    StructuredLightOptions options = Speckle();
    options.driver = driver;
    const ExplainedDepth frame =
        SeenByMatching(options, PlainWall(), {.distance_m = 2.0, .azimuth_rad = 0.4});
    std::set<int> steps;
    for (const uint16_t raw : frame.depth.raw) {
      if (raw == 0) continue;
      const double fb = 2.0 * 285.63 * 0.075;
      const double in_steps = fb / (raw * 0.001) / step_px;
      // Depth is rounded to millimetres.
      EXPECT_NEAR(in_steps, std::round(in_steps),
                  0.0005 * fb / std::pow(raw * 0.001, 2) / step_px + 1e-6);
      steps.insert(static_cast<int>(std::round(in_steps)));
    }
    EXPECT_GT(steps.size(), 20u);
  }
}

// 0.2 to 0.5 of a step of 1/8 px, from 0.5 to 4.5 m, in recordings of static scenes; more farther
// away. The share of the speckle that flickers was chosen by it.
TEST(MatchedDepthTest, DepthChangesLittleFromImageToImage) {
  StructuredLightOptions options = Speckle();
  options.driver = DepthDriver::kOpenNi;
  const StructuredLightSensor sensor(options);
  const RayCaster caster(PlainWall());
  for (const double z_m : {1.0, 2.0, 4.0}) {
    const Pose X_WB = RigPose({.distance_m = z_m, .azimuth_rad = 0.2}, Pose());
    // The same view, twice: the fixed speckle is that of the shot.
    StructuredLightOptions both = options;
    both.averaged_frames = 2;
    const cv::Mat1w one = sensor.ObserveDepth(caster, Dark(), X_WB, RandomStream(3)).depth.raw;
    const cv::Mat1w mean =
        StructuredLightSensor(both).ObserveDepth(caster, Dark(), X_WB, RandomStream(3)).depth.raw;
    double sum_m2 = 0.0;
    int count = 0;
    for (int v = 60; v < 180; ++v) {
      for (int u = 80; u < 240; ++u) {
        if (one(v, u) == 0 || mean(v, u) == 0) continue;
        const double difference_m = 2e-3 * (one(v, u) - mean(v, u));
        if (std::abs(difference_m) > 0.05 * z_m) continue;  // A wrong match in one of them.
        sum_m2 += difference_m * difference_m;
        ++count;
      }
    }
    const double step_m = 2.92e-3 * z_m * z_m;
    const double temporal_steps = std::sqrt(sum_m2 / count / 2.0) / step_m;
    EXPECT_GT(temporal_steps, 0.15) << z_m;
    EXPECT_LT(temporal_steps, 0.55) << z_m;
  }
}

// A plate at zo_m before a wall at zb_m: how many pixels of a row have no return [px at 640], left
// and right of the middle; means over rows, and over plates whose outlines cross pixels at
// different places.
struct Holes {
  double left_px = 0.0;
  double right_px = 0.0;
};
Holes HolesAroundAPlate(StructuredLightOptions options, double zo_m, double zb_m) {
  constexpr int kPlates = 6;
  constexpr int kRows = 100;
  options.depth_width_px = 640;
  options.depth_height_px = 480;
  options.depth_focal_px *= 2.0;
  Holes holes;
  for (int i = 0; i < kPlates; ++i) {
    Scene scene = PlainWall();
    const auto h = static_cast<float>(zo_m * (60.0 + 13.37 * i) / options.depth_focal_px);
    const auto z = static_cast<float>(zb_m - zo_m);
    scene.meshes.push_back({.name = "plate",
                            .positions_W = {{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}},
                            .triangles = {{0, 1, 2}, {0, 2, 3}},
                            .material = scene.meshes.front().material});
    const ExplainedDepth frame =
        SeenByMatching(options, scene, {.distance_m = zb_m}, Dark(), static_cast<uint64_t>(i));
    for (int v = 190; v < 190 + kRows; ++v) {
      for (int u = 20; u < 620; ++u) {
        if (frame.depth.raw(v, u) != 0) continue;
        (u < 320 ? holes.left_px : holes.right_px) += 1.0 / (kRows * kPlates);
      }
    }
  }
  return holes;
}

double ShadowWidth(double zo_m, double zb_m) {
  return 2.0 * 285.63 * 0.075 * (1.0 / zo_m - 1.0 / zb_m);
}

// Recorded: 3 to 4 px of 640 narrower than geometry, since blocks that hold a part of the
// foreground match it. The threshold was chosen by it; that narrow shadows are the more filled is a
// prediction.
TEST(MatchedDepthTest, AShadowIsLeftOfTheForegroundAndNarrowerThanGeometrySays) {
  // In one picture the width has a standard deviation of 0.3 px, since blocks of 9 rows share their
  // dots: 0.12 px in the mean of six.
  for (const auto& [zo_m, zb_m] : {std::pair{1.5, 2.0}, {1.2, 2.0}, {1.5, 3.0}, {0.9, 3.0}}) {
    const Holes holes = HolesAroundAPlate(Speckle(), zo_m, zb_m);
    EXPECT_NEAR(ShadowWidth(zo_m, zb_m) - holes.left_px, 3.5, 1.5) << zo_m << " before " << zb_m;
    // Recorded: none.
    EXPECT_LT(holes.right_px, 3.0) << zo_m << " before " << zb_m;
  }
  EXPECT_LT(HolesAroundAPlate(Speckle(), 1.7, 2.0).left_px, ShadowWidth(1.7, 2.0) - 1.0);
}

TEST(MatchedDepthTest, BlackPaintIsLostWithDistanceUnlessItIsBrightInTheInfraRed) {
  const auto share = [](double reflectance_830nm, double z_m) {
    Scene scene = PlainWall();
    for (Material& material : scene.materials) {
      material.reflectance_830nm = static_cast<float>(reflectance_830nm);
    }
    return ValidShare(SeenByMatching(Speckle(), scene, {.distance_m = z_m}));
  };
  // Half is lost between: a prediction, for paint whose reflectance at 830 nm is known has not been
  // recorded.
  EXPECT_GT(share(0.05, 2.2), 0.9);
  EXPECT_LT(share(0.02, 3.5), 0.2);
  EXPECT_GT(share(0.40, 3.9), 0.98);
}

TEST(MatchedDepthTest, ABlackFrameDropsOutUnlessItIsBrightInTheInfraRed) {
  // The frame of the paper's target, without the pixels whose blocks reach beyond it.
  const auto share = [](double reflectance_830nm, double z_m) {
    PaperTargetOptions target;
    target.frame_reflectance_830nm = reflectance_830nm;
    const RayCaster caster(MakePaperTarget(target));
    const StructuredLightSensor sensor(Speckle());
    const Pose X_WB = RigPose({.distance_m = z_m}, Pose());
    const ExplainedDepth frame = sensor.ObserveDepth(caster, Dark(), X_WB, RandomStream(1));
    cv::Mat1b is_frame = sensor.PixelTruth(caster, Dark(), X_WB).aovs.reflectance_830nm ==
                         static_cast<float>(reflectance_830nm);
    cv::erode(is_frame, is_frame, cv::Mat1b::ones(5, 5));
    EXPECT_GT(cv::countNonZero(is_frame), 500);
    return cv::countNonZero(is_frame & (frame.depth.raw != 0)) /
           static_cast<double>(cv::countNonZero(is_frame));
  };
  EXPECT_GT(share(0.05, 1.8), 0.9);
  EXPECT_LT(share(0.01, 1.8), 0.5);
  EXPECT_GT(share(0.40, 1.8), 0.98);
}

TEST(MatchedDepthTest, GlassLetsThePatternThroughToTheRoom) {
  FacadeOptions facade;
  facade.room.depth_m = 1.0;
  facade.room.paint.reflectance_830nm = 0.8;
  const auto middle_mm = [&](bool glass) {
    facade.window.glass = glass;
    const ExplainedDepth frame = SeenByMatching(Speckle(), MakeFacade(facade), {.distance_m = 1.5});
    const cv::Mat1w middle = frame.depth.raw(cv::Rect(150, 110, 20, 20));
    EXPECT_GT(cv::countNonZero(middle), 380) << glass;
    return cv::mean(middle, middle != 0)[0];
  };
  // The room's back wall, and not the pane; the pattern's noise there is 12 mm.
  EXPECT_NEAR(middle_mm(true), middle_mm(false), 10.0);
  EXPECT_GT(middle_mm(true), 2500.0);
}

// By shot noise in an exposure that gets shorter: far walls are lost in less light than near ones.
TEST(MatchedDepthTest, AmbientLightDrownsTheDotsOfFarWallsFirst) {
  const auto share = [](double lux, double z_m) {
    Lighting lighting;
    lighting.sky.illuminance_lx = lux;
    return ValidShare(SeenByMatching(Speckle(), PlainWall(), {.distance_m = z_m}, lighting));
  };
  EXPECT_GT(share(100.0, 3.5), 0.95);
  // Half of the sky's light reaches a wall.
  EXPECT_GT(share(100e3, 1.0), 0.9);
  EXPECT_LT(share(100e3, 3.5), 0.1);
}

TEST(MatchedDepthTest, NothingIsSeenOutsideTheRange) {
  for (const double z_m : {0.7, 4.3, 8.0}) {
    const ExplainedDepth frame = SeenByMatching(Speckle(), PlainWall(), {.distance_m = z_m});
    for (const uint16_t raw : frame.depth.raw) {
      if (raw == 0) continue;
      EXPECT_GE(raw, 800);
      EXPECT_LE(raw, 4000);
    }
    // Blocks of noise match by chance.
    EXPECT_LT(ValidShare(frame), 0.02) << z_m;
  }
  StructuredLightOptions near = Speckle();
  near.near_mode = true;
  EXPECT_GT(ValidShare(SeenByMatching(near, PlainWall(), {.distance_m = 0.5})), 0.95);
}

TEST(MatchedDepthTest, TheParametricModelIsLikeIt) {
  const auto compare = [](double reflectance_830nm, double z_m) {
    Scene scene = PlainWall();
    for (Material& material : scene.materials) {
      material.reflectance_830nm = static_cast<float>(reflectance_830nm);
    }
    const Viewpoint viewpoint{.distance_m = z_m, .azimuth_rad = 0.02};
    const ExplainedDepth speckle = SeenByMatching(Speckle(), scene, viewpoint);
    const ExplainedDepth parametric = SeenByMatching({}, scene, viewpoint);
    EXPECT_NEAR(ValidShare(parametric), ValidShare(speckle), 0.05)
        << reflectance_830nm << " at " << z_m;
    if (ValidShare(speckle) < 0.99) return;  // Wrong matches are far off.
    EXPECT_NEAR(PlaneResidual(parametric) / PlaneResidual(speckle), 1.0, 0.2)
        << reflectance_830nm << " at " << z_m;
  };
  for (const double z_m : {0.9, 1.4, 2.0, 3.0, 3.8}) compare(0.8, z_m);
  for (const double z_m : {0.9, 1.4, 2.0}) compare(0.2, z_m);
  for (const double z_m : {0.9, 1.4, 2.0, 3.0}) compare(0.05, z_m);
}

TEST(MatchedDepthTest, DepthIsWhereSomethingIsWhateverThePose) {
  for (const DepthModel model : {DepthModel::kMatched, DepthModel::kParametric}) {
    const testing::DepthOfNothing seen = testing::DepthWhereNothingIs(model, 1000, 5);
    EXPECT_EQ(seen.unexplained, 0);
    EXPECT_GT(seen.pixels, 100'000);
    // Blocks without any dots match by chance: 129 Φ(-4.05), of blocks that share their pixels.
    EXPECT_LT(static_cast<double>(seen.returns), 0.006 * static_cast<double>(seen.pixels));
  }
}

}  // namespace
}  // namespace fenestra
