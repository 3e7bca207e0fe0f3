#include "sim/stereo/stereo_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/io/input_error.h"
#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"

namespace fenestra {
namespace {

StereoRigOptions Ideal() {
  StereoRigOptions options;
  options.distortion = {};
  options.sensor.noise = false;
  options.sensor.fixed_pattern = false;
  options.sensor.black_level_dn = 0.0;
  options.as_designed = true;
  options.hover = {.speed_m_s = 0.0, .turn_rad_s = 0.0};
  options.trigger_skew_s = 0.0;
  return options;
}

// Column at which a row falls from bright to dark for the first time, to a fraction of a pixel: the
// crossing of the mean of the levels a few pixels to both sides.
double FirstDarkEdge(const cv::Mat1b& image, int row) {
  constexpr int kBeside = 5;
  const auto in = [&](int u) { return static_cast<double>(image(row, u)); };
  for (int u = kBeside; u + kBeside < image.cols; ++u) {
    if (in(u + kBeside) > 0.5 * in(u - kBeside)) continue;
    for (; u < image.cols; ++u) {
      const double middle = 0.5 * (in(u - kBeside) + in(u + kBeside));
      if (in(u - 1) >= middle && in(u) < middle) {
        return u - 1 + (in(u - 1) - middle) / (in(u - 1) - in(u));
      }
    }
  }
  return NAN;
}

TEST(StereoRigTest, DisparityOfAFlatTargetIsFocalLengthTimesBaselineOverDistance) {
  const StereoRig rig(Ideal(), RandomStream(1));
  const RayCaster caster(MakePaperTarget({}));
  const double f_px = rig.cameras().left.parameters().fx_px;
  for (const double distance_m : {2.0, 4.0}) {
    const Pose X_WB = RigPose({.distance_m = distance_m}, Pose());
    const StereoObservation seen = rig.Observe(caster, {}, X_WB, RandomStream(2));
    const double disparity_px = FirstDarkEdge(seen.left, 240) - FirstDarkEdge(seen.right, 240);
    // Linear interpolation over a blurred edge is wrong by up to some hundredths of a pixel,
    // depending on the edge's place within its pixel, which differs between the images.
    EXPECT_NEAR(disparity_px, f_px * 0.35 / distance_m, 0.08);
  }
}

TEST(StereoRigTest, ARigWithoutToleranceIsAsDesigned) {
  const StereoRig rig(Ideal(), RandomStream(1));
  EXPECT_EQ(rig.cameras(), DesignOf(Ideal()));
}

// RMS over rigs of what `departure` gives, over the tolerance, for 3 normal variates a camera.
template <typename Departure>
double RmsOverRigs(const StereoRigOptions& options, int rigs, Departure departure) {
  double sum = 0.0;
  for (int i = 0; i < rigs; ++i) {
    sum += departure(StereoRig(options, RandomStream(3).Child("rig", static_cast<uint64_t>(i))));
  }
  return std::sqrt(sum / rigs);
}

TEST(StereoRigTest, RigsScatterByTheirTolerances) {
  StereoRigOptions options;
  options.width_px = 64;  // Small images are built faster.
  options.height_px = 48;
  options.focal_length_m = 1e-3;
  const StereoCalibration design = DesignOf(options);
  constexpr int kRigs = 400;
  const double rotation = RmsOverRigs(options, kRigs, [](const StereoRig& rig) {
    return std::pow(Eigen::AngleAxisd(rig.X_BL().rotation()).angle(), 2);
  });
  const double translation = RmsOverRigs(options, kRigs, [](const StereoRig& rig) {
    return (rig.X_BR().translation() - Eigen::Vector3d(0.175, 0.0, 0.0)).squaredNorm();
  });
  const double focal = RmsOverRigs(options, kRigs, [&](const StereoRig& rig) {
    return std::pow(rig.cameras().left.parameters().fx_px / design.left.parameters().fx_px - 1.0,
                    2);
  });
  // An RMS of n normal variates has a relative standard deviation of 1/√(2n); five of them.
  const double of_three = 5.0 / std::sqrt(2.0 * 3.0 * kRigs);
  const double of_one = 5.0 / std::sqrt(2.0 * kRigs);
  EXPECT_NEAR(rotation / (std::sqrt(3.0) * options.tolerances.rotation_rad), 1.0, of_three);
  EXPECT_NEAR(translation / (std::sqrt(3.0) * options.tolerances.translation_m), 1.0, of_three);
  EXPECT_NEAR(focal / options.tolerances.focal_length, 1.0, of_one);
}

TEST(StereoRigTest, ADisplacedRigSeesWhatItsNewPoseShows) {
  const StereoRig rig(Ideal(), RandomStream(1));
  const Pose X_RRnew(RotationFromVector({0.0, 1e-3, 0.0}), {1e-3, 0.0, 0.0});
  const StereoRig shaken = rig.Displaced(X_RRnew);
  EXPECT_LT((shaken.X_BR().translation() - Eigen::Vector3d(0.176, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(shaken.X_BL(), rig.X_BL());
  EXPECT_EQ(shaken.cameras().right, rig.cameras().right);
}

TEST(StereoRigTest, NoiseIsAFunctionOfItsStream) {
  const StereoRig rig({}, RandomStream(1));
  const RayCaster caster(MakePaperTarget({}));
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  const StereoObservation a = rig.Observe(caster, {}, X_WB, RandomStream(2));
  const StereoObservation b = rig.Observe(caster, {}, X_WB, RandomStream(2));
  const StereoObservation c = rig.Observe(caster, {}, X_WB, RandomStream(3));
  EXPECT_EQ(cv::norm(a.left, b.left, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(a.left, c.left, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(a.left, a.right, cv::NORM_INF), 0.0);
}

TEST(StereoRigTest, AutomaticExposureMakesBrightnessIrrelevant) {
  StereoRigOptions options = Ideal();
  options.exposure.set_point = 0.3;
  const StereoRig rig(options, RandomStream(1));
  const RayCaster caster(MakePaperTarget({}));
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  Lighting bright;
  bright.sky.illuminance_lx = 5000.0;
  const auto mean = [&](const Lighting& lighting) {
    return cv::mean(rig.Observe(caster, lighting, X_WB, RandomStream(2)).left)[0];
  };
  // Shifting right rounds downwards, by 3/8 DN on average.
  EXPECT_NEAR(mean({}), 0.3 * 1023.0 / 4.0 - 0.375, 0.3);
  EXPECT_NEAR(mean(bright), 0.3 * 1023.0 / 4.0 - 0.375, 0.3);
}

// A target that fills more of one image than of the other.
const Pose kBeside = RigPose({.distance_m = 1.2, .yaw_rad = 0.4}, Pose());

// Share of full scale that a view's electrons are on average.
double MeanShare(const ExposedView& view) {
  return view.exposure.gain * cv::mean(view.electrons)[0] / view.sensor.saturation_e;
}

TEST(StereoRigTest, EachCameraIsExposedByItsOwnImage) {
  StereoRigOptions options = Ideal();
  options.as_designed = false;  // Cameras of different gain.
  options.tolerances.gain = 0.1;
  options.exposure.set_point = 0.3;
  const RayCaster caster(MakePaperTarget({}));
  const auto shot = [&](bool own_exposure) {
    options.own_exposure = own_exposure;
    return StereoRig(options, RandomStream(1)).Shoot(caster, {}, kBeside, RandomStream(2));
  };
  const StereoShot own = shot(true);
  // The coarse picture that meters the light has its mean to a few tenths of a per cent.
  EXPECT_NEAR(MeanShare(own.left), 0.3, 0.003);
  EXPECT_NEAR(MeanShare(own.right), 0.3, 0.003);
  const StereoShot shared = shot(false);
  EXPECT_EQ(shared.right.exposure.exposure_s, own.left.exposure.exposure_s);
  EXPECT_GT(std::abs(MeanShare(shared.right) - 0.3), 0.01);
}

TEST(StereoRigTest, CamerasScatterInGainAndDecentringByTheirTolerances) {
  StereoRigOptions options;
  options.width_px = 64;
  options.height_px = 48;
  options.focal_length_m = 1e-3;
  options.exposure.automatic = false;
  options.tolerances.gain = 0.03;
  const RayCaster caster(MakePaperTarget({}));
  constexpr int kRigs = 200;
  double left2 = 0.0;
  double product = 0.0;
  double decentred2 = 0.0;
  for (uint64_t i = 0; i < kRigs; ++i) {
    const StereoShot shot = StereoRig(options, RandomStream(3).Child("rig", i))
                                .Shoot(caster, {}, kBeside, RandomStream(2));
    const double left = options.sensor.saturation_e / shot.left.sensor.saturation_e - 1.0;
    const double right = options.sensor.saturation_e / shot.right.sensor.saturation_e - 1.0;
    decentred2 += shot.right.spread.coma_centre.squaredNorm() / (2.0 * kRigs);
    left2 += left * left / kRigs;
    product += left * right / kRigs;
  }
  EXPECT_NEAR(std::sqrt(left2) / 0.03, 1.0, 5.0 / std::sqrt(2.0 * kRigs));
  EXPECT_NEAR(product / (0.03 * 0.03), 0.0, 5.0 / std::sqrt(kRigs));
  EXPECT_NEAR(std::sqrt(decentred2) / options.tolerances.coma_centre, 1.0,
              5.0 / std::sqrt(4.0 * kRigs));
}

TEST(StereoRigTest, TheMiddleOfALongerExposureIsLater) {
  // Flying sideways at 10 m/s, with cameras whose gains and so exposures differ by some tenths.
  // Both exposures begin together: the right one's middle is later by half the difference, which
  // moves its image by f v Δt / 2z beside that of a rig whose cameras have one exposure.
  StereoRigOptions options = Ideal();
  options.as_designed = false;
  options.tolerances = {.focal_length = 0.0,
                        .principal_point_px = 0.0,
                        .distortion = 0.0,
                        .rotation_rad = 0.0,
                        .translation_m = 0.0,
                        .gain = 0.15};
  options.motion.velocity_B = {10.0, 0.0, 0.0};
  const RayCaster caster(MakePaperTarget({}));
  Lighting bright;
  bright.sky.illuminance_lx = 2000.0;
  const Pose X_WB = RigPose({.distance_m = 4.0}, Pose());
  const auto shot = [&](bool own_exposure) {
    options.own_exposure = own_exposure;
    return StereoRig(options, RandomStream(1)).Shoot(caster, bright, X_WB, RandomStream(2));
  };
  const StereoShot own = shot(true);
  const StereoShot shared = shot(false);
  const double later_s = 0.5 * (own.right.exposure.exposure_s - own.left.exposure.exposure_s);
  const double expected_px = -DesignOf(options).left.parameters().fx_px * 10.0 * later_s / 4.0;
  EXPECT_GT(std::abs(expected_px), 0.3);
  EXPECT_NEAR(
      FirstDarkEdge(own.observation.right, 240) - FirstDarkEdge(shared.observation.right, 240),
      expected_px, 0.1);
}

TEST(StereoRigTest, TheRightCameraIsLateByItsSkew) {
  // Flying sideways at 2 m/s, 10 ms late: the right camera is 20 mm farther to the right, which
  // takes f · 0.02 m / z from the right image's columns. The left image does not change.
  StereoRigOptions options = Ideal();
  options.exposure = {.automatic = false, .exposure_s = 1e-5, .gain = 4.0};
  options.motion.velocity_B = {2.0, 0.0, 0.0};
  StereoRigOptions late = options;
  late.trigger_skew_s = 10e-3;
  const RayCaster caster(MakePaperTarget({}));
  Lighting bright;
  bright.sky.illuminance_lx = 1e5;
  const Pose X_WB = RigPose({.distance_m = 4.0}, Pose());
  const auto seen = [&](const StereoRigOptions& o) {
    return StereoRig(o, RandomStream(1)).Observe(caster, bright, X_WB, RandomStream(2));
  };
  const StereoObservation in_time = seen(options);
  const StereoObservation skewed = seen(late);
  EXPECT_EQ(cv::norm(in_time.left, skewed.left, cv::NORM_INF), 0.0);
  const double f_px = DesignOf(options).left.parameters().fx_px;
  EXPECT_NEAR(FirstDarkEdge(in_time.right, 240) - FirstDarkEdge(skewed.right, 240),
              f_px * 0.02 / 4.0, 0.08);
}

TEST(StereoRigTest, AHoveringRigMovesAnewInEachImageAndStandsForBoards) {
  StereoRigOptions options = Ideal();
  options.motion.velocity_B = {0.0, 0.0, 1.0};
  options.hover = {.speed_m_s = 0.2, .turn_rad_s = 0.1};
  const StereoRig rig(options, RandomStream(1));
  constexpr int kImages = 2000;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double speed2 = 0.0;
  double turn2 = 0.0;
  for (uint64_t i = 0; i < kImages; ++i) {
    const RigMotion motion = rig.MotionDuring(RandomStream(2).Child("image", i));
    mean += motion.velocity_B / kImages;
    speed2 += (motion.velocity_B - options.motion.velocity_B).squaredNorm() / (3.0 * kImages);
    turn2 += motion.angular_velocity_B.squaredNorm() / (3.0 * kImages);
  }
  // Five standard deviations of a mean, and of the RMS of 3 n variates, 1/√(6n).
  EXPECT_LT((mean - options.motion.velocity_B).norm(), 5.0 * 0.2 * std::sqrt(3.0 / kImages));
  EXPECT_NEAR(std::sqrt(speed2) / 0.2, 1.0, 5.0 / std::sqrt(6.0 * kImages));
  EXPECT_NEAR(std::sqrt(turn2) / 0.1, 1.0, 5.0 / std::sqrt(6.0 * kImages));
  EXPECT_TRUE(rig.Still().MotionDuring(RandomStream(2)).still());
}

TEST(StereoRigTest, MotionSmearsAnEdgeOverTheDistanceThatItMoves) {
  // Sideways at 3 m/s for 8 ms at 4 m: f · 0.024 m / z = 4 px. A uniform smear of 4 px adds 4²/12
  // to the variance of an edge's slope.
  StereoRigOptions options = Ideal();
  options.exposure = {.automatic = false, .exposure_s = 8e-3, .gain = 1.0};
  const RayCaster caster(MakePaperTarget({}));
  const Pose X_WB = RigPose({.distance_m = 4.0}, Pose());
  const auto slope_variance = [&](double speed) {
    options.motion.velocity_B = {speed, 0.0, 0.0};
    const cv::Mat1b image =
        StereoRig(options, RandomStream(1)).Observe(caster, {}, X_WB, RandomStream(2)).left;
    const int edge = static_cast<int>(FirstDarkEdge(image, 240));
    double sum = 0.0;
    double first = 0.0;
    double second = 0.0;
    for (int u = edge - 6; u < edge + 6; ++u) {
      const double step = image(240, u) - image(240, u + 1);
      sum += step;
      first += step * (u - edge);
      second += step * (u - edge) * (u - edge);
    }
    return second / sum - std::pow(first / sum, 2);
  };
  const double smear_px = DesignOf(options).left.parameters().fx_px * 0.024 / 4.0;
  // 8-bit steps on an edge of 100 DN.
  EXPECT_NEAR(slope_variance(3.0) - slope_variance(0.0), smear_px * smear_px / 12.0, 0.15);
}

TEST(StereoRigTest, APointSpreadIsWiderWhereTheSceneIsOutOfFocus) {
  // A target at 1 m before a lens that is in focus at 3 m: f²/(N pitch) (1/1 - 1/3) in the middle.
  const StereoRig rig(Ideal(), RandomStream(1));
  const RayCaster caster(MakePaperTarget({}));
  const auto confusion_at = [&](double distance_m) {
    const Pose X_WB = RigPose({.distance_m = distance_m}, Pose());
    const cv::Mat1f& map = rig.Shoot(caster, {}, X_WB, RandomStream(2)).left.spread.confusion_px;
    return static_cast<double>(map(map.rows / 2, map.cols / 2));
  };
  const double px_m = 4e-3 * 4e-3 / (2.8 * 6e-6);
  EXPECT_NEAR(confusion_at(1.0), px_m * (1.0 - 1.0 / 3.0), 1e-3);
  EXPECT_NEAR(confusion_at(3.0), 0.0, 1e-3);
}

TEST(StereoRigTest, TruthIsInTheTrueLeftCamera) {
  const StereoRig rig(Ideal(), RandomStream(1));
  const Scene scene = MakePaperTarget({});
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  const GroundTruth truth = rig.Truth(scene, X_WB);
  ASSERT_TRUE(truth.target);
  EXPECT_LT((truth.target->p_CO - Eigen::Vector3d(0.175, 0.0, 2.0)).norm(), 1e-12);
  EXPECT_TRUE(truth.in_view);

  const StereoRig built({}, RandomStream(5));
  const Pose X_LW = (X_WB * built.X_BL()).inverse();
  EXPECT_LT((built.Truth(scene, X_WB).target->p_CO - X_LW * Eigen::Vector3d::Zero()).norm(), 1e-12);
}

TEST(StereoRigTest, AbsurdOptionsAreRefusedAllAtOnce) {
  StereoRigOptions options;
  options.baseline_m = -1.0;
  options.focal_length_m = 0.0;
  try {
    StereoRig rig(options, RandomStream(1));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 2u);
  }
}

}  // namespace
}  // namespace fenestra
