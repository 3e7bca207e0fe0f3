#include "sim/stereo_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/input_error.h"
#include "scenes/paper_target.h"
#include "sim/viewpoint.h"

namespace fenestra {
namespace {

StereoRigOptions Ideal() {
  StereoRigOptions options;
  options.distortion = {};
  options.sensor.noise = false;
  options.rotation_tolerance_rad = 0.0;
  options.translation_tolerance_m = 0.0;
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
  const StereoRig rig(Ideal());
  const RayCaster caster(MakePaperTarget({}));
  const double f_px = rig.nominal().left.parameters().fx_px;
  for (const double distance_m : {2.0, 4.0}) {
    const Pose X_WB = RigPose({.distance_m = distance_m}, Pose());
    const StereoObservation seen =
        rig.Observe(caster, {}, X_WB, rig.Draw(RandomStream(1)), RandomStream(2));
    const double disparity_px = FirstDarkEdge(seen.left, 240) - FirstDarkEdge(seen.right, 240);
    // Linear interpolation over a blurred edge is wrong by up to some hundredths of a pixel,
    // depending on the edge's place within its pixel, which differs between the images.
    EXPECT_NEAR(disparity_px, f_px * 0.35 / distance_m, 0.08);
  }
}

TEST(StereoRigTest, AnIdealRigIsAsDetectorsAreTold) {
  const StereoRig rig(Ideal());
  const StereoRig::TrueState state = rig.Draw(RandomStream(1));
  const Pose X_RL = state.X_BR.inverse() * state.X_BL;
  EXPECT_LT((X_RL.translation() - rig.nominal().X_RL.translation()).norm(), 1e-15);
  EXPECT_LT((X_RL.rotation() - rig.nominal().X_RL.rotation()).norm(), 1e-15);
}

TEST(StereoRigTest, RigsScatterByTheirTolerances) {
  const StereoRig rig{StereoRigOptions{}};
  double rotation2 = 0.0;
  double translation2 = 0.0;
  constexpr int kRigs = 500;
  for (int i = 0; i < kRigs; ++i) {
    const StereoRig::TrueState state = rig.Draw(RandomStream(3).Child("rig", uint64_t(i)));
    const Pose X_RL = state.X_BR.inverse() * state.X_BL;
    rotation2 += std::pow(Eigen::AngleAxisd(X_RL.rotation()).angle(), 2);
    translation2 += (state.X_BR.translation() - Eigen::Vector3d(0.175, 0.0, 0.0)).squaredNorm();
  }
  // 3 kRigs squared normals: relative standard deviation √(2 / 1500) = 0.037; five of them.
  EXPECT_NEAR(rotation2 / (3.0 * kRigs * 1e-8), 1.0, 0.18);
  EXPECT_NEAR(translation2 / (3.0 * kRigs * 1e-8), 1.0, 0.18);
}

TEST(StereoRigTest, NoiseIsAFunctionOfItsStream) {
  const StereoRig rig{StereoRigOptions{}};
  const RayCaster caster(MakePaperTarget({}));
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  const StereoRig::TrueState state = rig.Draw(RandomStream(1));
  const StereoObservation a = rig.Observe(caster, {}, X_WB, state, RandomStream(2));
  const StereoObservation b = rig.Observe(caster, {}, X_WB, state, RandomStream(2));
  const StereoObservation c = rig.Observe(caster, {}, X_WB, state, RandomStream(3));
  EXPECT_EQ(cv::norm(a.left, b.left, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(a.left, c.left, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(a.left, a.right, cv::NORM_INF), 0.0);
}

TEST(StereoRigTest, AutomaticExposureMakesBrightnessIrrelevant) {
  StereoRigOptions options = Ideal();
  options.exposure.set_point = 0.3;
  const StereoRig rig(options);
  const RayCaster caster(MakePaperTarget({}));
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  Lighting bright;
  bright.sky.illuminance_lx = 5000.0;
  const auto mean = [&](const Lighting& lighting) {
    const auto seen =
        rig.Observe(caster, lighting, X_WB, rig.Draw(RandomStream(1)), RandomStream(2));
    return cv::mean(seen.left)[0];
  };
  EXPECT_NEAR(mean({}), 0.3 * 255.0, 0.5);
  EXPECT_NEAR(mean(bright), 0.3 * 255.0, 0.5);
}

TEST(StereoRigTest, TruthIsInTheTrueLeftCamera) {
  const StereoRig rig{StereoRigOptions{}};
  const Scene scene = MakePaperTarget({});
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  const GroundTruth truth = rig.Truth(scene, X_WB, rig.Draw(RandomStream(1)));
  ASSERT_TRUE(truth.target);
  EXPECT_LT((truth.target->p_CO - Eigen::Vector3d(0.175, 0.0, 2.0)).norm(), 1e-12);
  EXPECT_TRUE(truth.in_view);
}

TEST(StereoRigTest, AbsurdOptionsAreRefusedAllAtOnce) {
  StereoRigOptions options;
  options.baseline_m = -1.0;
  options.focal_length_m = 0.0;
  try {
    StereoRig rig(options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 2u);
  }
}

}  // namespace
}  // namespace fenestra
