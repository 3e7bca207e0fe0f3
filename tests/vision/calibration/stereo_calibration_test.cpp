#include "vision/calibration/stereo_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "core/io/input_error.h"
#include "tests/vision/calibration/normalised_error.h"
#include "tests/vision/calibration/synthetic_boards.h"

namespace fenestra {
namespace {

using testing::ExamplePair;
using ::testing::HasSubstr;
using testing::kExampleSizes;
using testing::kFreeParameters;
using testing::NormalisedSquaredError;
using testing::SyntheticViews;

TEST(StereoCalibrationTest, CornersWithoutNoiseGiveThePairBack) {
  const StereoCalibration truth = ExamplePair();
  const CalibrationBoard board;
  const auto views = SyntheticViews(truth, board, 10, 0.0, RandomStream(1));
  const StereoCalibrationResult result = CalibrateStereo(views, board, kExampleSizes);
  const PairVector error = PairError(result.calibration, truth);
  // OpenCV's start is in single precision; the adjustment is not.
  for (int i = 0; i < kPairParameters; ++i) {
    EXPECT_NEAR(error[i], 0.0, 1e-6) << PairParameterNames()[static_cast<size_t>(i)];
  }
  EXPECT_LT(result.rms_px, 1e-7);
}

TEST(StereoCalibrationTest, CovarianceIsHonest) {
  // The sum over 100 calibrations of the normalised squared error follows χ² with 100 · 22 degrees
  // of freedom; the test is two-sided with a false-alarm rate of 1 %. Corners' σ is estimated from
  // some 4000 residuals, which widens the law by far less than its own spread of 3 %.
  const StereoCalibration truth = ExamplePair();
  const CalibrationBoard board;
  constexpr int kCalibrations = 100;
  double sum = 0.0;
  for (uint64_t i = 0; i < kCalibrations; ++i) {
    const auto views = SyntheticViews(truth, board, 20, 0.05, RandomStream(4).Child("session", i));
    const StereoCalibrationResult result = CalibrateStereo(views, board, kExampleSizes);
    sum += NormalisedSquaredError(PairError(result.calibration, truth), result.covariance);
  }
  const boost::math::chi_squared law(kCalibrations * kFreeParameters);
  const double low = boost::math::quantile(law, 0.005);
  const double high = boost::math::quantile(law, 0.995);
  EXPECT_GT(sum, low);
  EXPECT_LT(sum, high);
  // The twins: covariances halved, and doubled.
  EXPECT_GT(2.0 * sum, high);
  EXPECT_LT(0.5 * sum, low);
}

TEST(StereoCalibrationTest, CornerDeviationIsThatOfTheNoise) {
  const CalibrationBoard board;
  const auto views = SyntheticViews(ExamplePair(), board, 20, 0.1, RandomStream(7));
  const StereoCalibrationResult result = CalibrateStereo(views, board, kExampleSizes);
  // 4320 residuals less 142 unknowns: relative deviation 1/√(2 · 4178) = 1.1 %; four of them.
  EXPECT_NEAR(result.corner_deviation_px / 0.1, 1.0, 0.044);
}

TEST(StereoCalibrationTest, AWrongDetectionIsLeftOutByItsResiduals) {
  const StereoCalibration truth = ExamplePair();
  const CalibrationBoard board;
  auto views = SyntheticViews(truth, board, 12, 0.05, RandomStream(3));
  // Off by one square along the row.
  for (BoardCorner& corner : views[5].corners.right) corner.pixel.x() += 25.0;
  views[5].corners.right.front().pixel.y() += 8.0;
  const StereoCalibrationResult result = CalibrateStereo(views, board, kExampleSizes);
  ASSERT_EQ(result.left_out.size(), 1u);
  EXPECT_EQ(result.left_out.front().name, "5");
  EXPECT_THAT(result.left_out.front().reason, HasSubstr("residuals"));
  EXPECT_LT(std::abs(PairError(result.calibration, truth)[21]), 1e-3);
}

TEST(StereoCalibrationTest, TooFewViewsAreRefused) {
  const CalibrationBoard board;
  auto views = SyntheticViews(ExamplePair(), board, 3, 0.05, RandomStream(3));
  views[1].corners.right.clear();
  try {
    CalibrateStereo(views, board, kExampleSizes);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("2 views; 3 are the least"));
  }
}

TEST(StereoCalibrationTest, ParallelBoardsAreRefused) {
  const CalibrationBoard board;
  const auto views = SyntheticViews(ExamplePair(), board, 8, 0.05, RandomStream(3), 1e-4);
  try {
    CalibrateStereo(views, board, kExampleSizes);
    FAIL() << "a focal length that no view determines was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("tilted in different directions"));
  }
}

TEST(PairErrorTest, IsZeroForEqualPairsAndTheRotationVectorForTurnedOnes) {
  const StereoCalibration pair = ExamplePair();
  EXPECT_LT(PairError(pair, pair).norm(), 1e-9);
  StereoCalibration turned = pair;
  const Eigen::Vector3d turn(1e-3, -2e-3, 3e-3);
  turned.X_RL = Pose(RotationFromVector(turn) * pair.X_RL.rotation(), pair.X_RL.translation());
  EXPECT_LT((PairError(pair, turned).segment<3>(18) - turn).norm(), 1e-12);
}

}  // namespace
}  // namespace fenestra
