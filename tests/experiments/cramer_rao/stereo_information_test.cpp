#include "experiments/cramer_rao/trial_information.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>

#include "tests/vision/stereo/exact_bound.h"
#include "tests/vision/stereo/stereo_scene.h"

namespace fenestra {
namespace {

using testing::ExactBound;
using testing::ExactFrame;
using testing::ExactJacobian;
using testing::ExactPicture;
using testing::ExactPixels;
using testing::View;
using testing::WindowSeenFrom;

constexpr double kNoise = 2.0;

StereoCalibration RigOf(const CameraModel& camera, double baseline_m = 0.35) {
  return {camera, camera, Pose::Translation({-baseline_m, 0.0, 0.0})};
}
// Half and a quarter of the size of the paper's images, for tests with many pictures.
StereoCalibration SmallRig(double baseline_m = 0.35) {
  return RigOf(CameraModel::Pinhole(376, 240, 333.0), baseline_m);
}
StereoCalibration TinyRig() {
  return RigOf(CameraModel::Pinhole(188, 120, 166.5));
}

const std::array<View, 3> kViews = {
    View{.distance_m = 2.5, .azimuth_deg = 7.0, .roll_deg = 4.0},
    View{.distance_m = 3.5, .azimuth_deg = -35.0, .roll_deg = 2.0},
    View{.distance_m = 4.5, .azimuth_deg = 10.0, .pitch_deg = 2.0, .roll_deg = 8.0}};

ExactFrame FrameSeenFrom(const View& view) {
  return {.X_LO = WindowSeenFrom(view)};
}

// The same noise in each pixel, fine steps, one electron for each unit of the exact pictures.
PixelNoise FixedNoise(double deviation) {
  return PixelNoise::Linear({.saturation_e = 1000.0,
                             .dsnu_e = deviation,
                             .prnu = 0.0,
                             .adc_bits = 16,
                             .output_bits = 16,
                             .black_level_dn = 0.0,
                             .noise = false},
                            {});
}

// Noise of the light itself and nothing else.
PixelNoise ShotNoise() {
  return PixelNoise::Linear({.saturation_e = 1e5,
                             .read_noise_e = 1.0,
                             .adc_bits = 16,
                             .output_bits = 16,
                             .black_level_dn = 0.0,
                             .fixed_pattern = false},
                            {});
}

FrameState StateOf(const ExactFrame& frame) {
  return {.X_CO = frame.X_LO,
          .width_m = frame.width_m,
          .height_m = frame.height_m,
          .border_m = frame.border_m};
}

Eigen::MatrixXd InformationOf(const StereoCalibration& rig, const ExactFrame& frame,
                              const PixelNoise& noise) {
  const auto picture = [&](const CameraModel& camera, const Pose& X_CL) {
    return StereoPicture{
        .electrons = ExactPicture(camera, X_CL, frame),
        .noise = noise,
        .spread = {.centre_sigma_px = frame.blur_px, .corner_sigma_px = frame.blur_px}};
  };
  return StereoInformation(StateOf(frame), {.cameras = rig,
                                            .left = picture(rig.left, Pose()),
                                            .right = picture(rig.right, rig.X_RL)})
      .value();
}

Eigen::Matrix3d BoundOf(const ExactFrame& frame, const PixelNoise& noise,
                        const PriorKnowledge& knowledge = {}) {
  return StereoBound(InformationOf(SmallRig(), frame, noise), knowledge).value();
}

// Of a - b, symmetric.
double LeastEigenvalue(const Eigen::Matrix3d& difference) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(difference).eigenvalues()[0];
}

TEST(StereoInformationTest, AgreesWithAllPixelsOfExactPictures) {
  for (const View& view : kViews) {
    const ExactFrame frame = FrameSeenFrom(view);
    const Eigen::Matrix3d bound = BoundOf(frame, FixedNoise(kNoise));
    const Eigen::Matrix3d exact = ExactBound(SmallRig(), frame, kNoise * kNoise);
    for (int axis = 0; axis < 3; ++axis) {
      // What differs: each side of each picture has levels of its own here, and corners.
      EXPECT_NEAR(std::sqrt(bound(axis, axis) / exact(axis, axis)), 1.03, 0.08)
          << view.distance_m << " m, axis " << axis;
    }
  }
}

// Fits exact pictures to noisy ones by maximum likelihood, which for normal noise is least squares.
Eigen::Vector3d FittedError(const StereoCalibration& rig, const ExactFrame& truth,
                            const Eigen::VectorXd& pixels, const Eigen::MatrixXd& jacobian) {
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  ExactFrame fitted = truth;
  for (int round = 0; round < 2; ++round) {
    const Eigen::VectorXd residuals = pixels - ExactPixels(rig, fitted);
    fitted = Changed(fitted, normal.ldlt().solve(jacobian.transpose() * residuals));
  }
  return fitted.X_LO.translation() - truth.X_LO.translation();
}

// Σ eᵀ C⁻¹ e of `count` fits is χ² with 3 count degrees of freedom if C is their covariance.
// Two-sided, wrong once in a thousand.
bool IsCovarianceOf(double sum, int count) {
  const boost::math::chi_squared distribution(3.0 * count);
  return sum > quantile(distribution, 5e-4) && sum < quantile(complement(distribution, 5e-4));
}

TEST(StereoInformationTest, MaximumLikelihoodAttainsTheBound) {
  constexpr int kFits = 40;
  const StereoCalibration rig = TinyRig();
  double sum = 0.0;
  int fits = 0;
  for (const View& view : kViews) {
    const ExactFrame frame = FrameSeenFrom(view);
    const Eigen::Matrix3d inverse =
        StereoBound(InformationOf(rig, frame, FixedNoise(kNoise)), {}).value().inverse();
    const Eigen::VectorXd exact = ExactPixels(rig, frame);
    const Eigen::MatrixXd jacobian = ExactJacobian(rig, frame);
    for (int fit = 0; fit < kFits; ++fit, ++fits) {
      std::vector<float> noise(static_cast<size_t>(exact.size()));
      RandomStream(5).Child("fit", static_cast<uint64_t>(fits)).FillNormals(noise);
      const Eigen::Map<const Eigen::VectorXf> normals(noise.data(), exact.size());
      const Eigen::Vector3d error =
          FittedError(rig, frame, exact + kNoise * normals.cast<double>(), jacobian);
      sum += error.dot(inverse * error);
    }
  }
  EXPECT_TRUE(IsCovarianceOf(sum, fits)) << sum / fits << " of 3";
  // The twins with a fault: a bound of half the variance, or twice.
  EXPECT_FALSE(IsCovarianceOf(2.0 * sum, fits));
  EXPECT_FALSE(IsCovarianceOf(0.5 * sum, fits));
}

TEST(StereoInformationTest, HalfTheFixedNoiseHalvesTheBound) {
  const ExactFrame frame = FrameSeenFrom(kViews[1]);
  // Steps of 1000/65535 are noise of their own.
  const double step2 = std::pow(1000.0 / 65535.0, 2) / 12.0;
  const double half = std::sqrt((kNoise * kNoise + step2) / 4.0 - step2);
  const Eigen::Matrix3d whole = BoundOf(frame, FixedNoise(kNoise));
  EXPECT_TRUE(whole.isApprox(4.0 * BoundOf(frame, FixedNoise(half)), 1e-9));
}

TEST(StereoInformationTest, MoreLightTightensTheBoundAsShotNoiseSays) {
  ExactFrame frame = FrameSeenFrom(kViews[0]);
  const Eigen::Matrix3d dim = BoundOf(frame, ShotNoise());
  for (double* level : {&frame.wall_dn, &frame.frame_dn, &frame.opening_dn}) *level *= 4.0;
  const Eigen::Matrix3d bright = BoundOf(frame, ShotNoise());
  EXPECT_GT(LeastEigenvalue(dim - bright), 0.0);
  // Contrast x 4, noise x 2; a little more of it was read noise of 1 e before.
  EXPECT_NEAR(std::sqrt(dim.trace() / bright.trace()), 2.0, 0.1);
}

TEST(StereoInformationTest, KnowingTheSizeHelpsAndDoubtOfTheCalibrationHurts) {
  const ExactFrame frame = FrameSeenFrom({.distance_m = 4.5, .azimuth_deg = 10.0});
  const PixelNoise noise = FixedNoise(kNoise);
  const Eigen::Matrix3d plain = BoundOf(frame, noise);
  const Eigen::Matrix3d sized = BoundOf(frame, noise, {.size_sigma_m = 1e-6, .calibration = {}});
  EXPECT_GT(LeastEigenvalue(plain - sized), -1e-6 * plain.trace());
  EXPECT_LT(sized(2, 2), 0.5 * plain(2, 2));  // The window is wider than the rig.
  EXPECT_TRUE(
      BoundOf(frame, noise, {.size_sigma_m = 1e3, .calibration = {}}).isApprox(plain, 1e-6));
  // A vague idea is between both.
  const Eigen::Matrix3d vague = BoundOf(frame, noise, {.size_sigma_m = 1e-3, .calibration = {}});
  EXPECT_GT(vague(2, 2), sized(2, 2));
  EXPECT_LT(vague(2, 2), plain(2, 2));

  PairMatrix doubt = PairMatrix::Zero();
  EXPECT_TRUE(
      BoundOf(frame, noise, {.size_sigma_m = {}, .calibration = doubt}).isApprox(plain, 1e-9));
  // About the vertical axis: σ_z = z² σ/b, as far as the pictures themselves do not tell it.
  const double yaw_rad = 1e-5;
  doubt(19, 19) = yaw_rad * yaw_rad;
  const Eigen::Matrix3d turned = BoundOf(frame, noise, {.size_sigma_m = {}, .calibration = doubt});
  const double by_yaw_m = std::pow(frame.X_LO.translation().z(), 2) * yaw_rad / 0.35;
  EXPECT_NEAR(turned(2, 2) - plain(2, 2), by_yaw_m * by_yaw_m, 0.1 * by_yaw_m * by_yaw_m);
}

TEST(StereoInformationTest, ScalingTheWorldScalesTheBound) {
  ExactFrame frame = FrameSeenFrom(kViews[2]);
  const Eigen::Matrix3d one = BoundOf(frame, FixedNoise(kNoise));
  frame.X_LO = Pose(frame.X_LO.rotation(), 3.0 * frame.X_LO.translation());
  for (double* length : {&frame.width_m, &frame.height_m, &frame.border_m}) *length *= 3.0;
  const Eigen::Matrix3d three =
      StereoBound(InformationOf(SmallRig(3.0 * 0.35), frame, FixedNoise(kNoise)), {}).value();
  // Pictures are the same but for their last bits.
  EXPECT_TRUE(three.isApprox(9.0 * one, 1e-5));
}

TEST(StereoInformationTest, AFrameThatLeavesAnImageHasNoBound) {
  ExactFrame frame = FrameSeenFrom({.distance_m = 3.0});
  const Eigen::MatrixXd picture = InformationOf(SmallRig(), frame, FixedNoise(kNoise));
  EXPECT_GT(picture(0, 0), 0.0);
  const StereoCalibration rig = SmallRig();
  const cv::Mat1f white(240, 376, 100.0f);
  FrameState aside = StateOf(frame);
  aside.X_CO = Pose(aside.X_CO.rotation(), aside.X_CO.translation() + Eigen::Vector3d(1.5, 0, 0));
  const StereoPicture picture_of_white{white, FixedNoise(kNoise), {0.4, 0.4}};
  EXPECT_FALSE(StereoInformation(aside, {rig, picture_of_white, picture_of_white}));
}

}  // namespace
}  // namespace fenestra
