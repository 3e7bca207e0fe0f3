#include "experiments/trial/scoring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/io/input_error.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

using testing::EstimateAt;
using Answer = std::variant<Detection, Crash>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

WindowTruth Window(const Eigen::Vector3d& p_CO, double width_m = 1.0, double height_m = 1.0) {
  return {.p_CO = p_CO,
          .p_CV = {p_CO, p_CO, p_CO, p_CO},  // Not used by the score.
          .normal_C = -Eigen::Vector3d::UnitZ(),
          .width_m = width_m,
          .height_m = height_m};
}

GroundTruth Scene(std::optional<WindowTruth> target, std::vector<WindowTruth> others = {}) {
  return {.X_WC = Pose(),
          .target = std::move(target),
          .other_windows = std::move(others),
          .in_view = true};
}

const GroundTruth kTargetAhead = Scene(Window({0.0, 0.0, 2.0}));

Outcome OutcomeAt(const Eigen::Vector3d& p_CO, const GroundTruth& truth = kTargetAhead) {
  return ScoreDetection(Detection(EstimateAt(p_CO)), truth).outcome;
}

TEST(Scoring, AHitEndsExactlyAtAQuarterOfTheSide) {
  // 2.25 - 2 = 0.25 without rounding; the next double is outside.
  EXPECT_EQ(OutcomeAt({0.0, 0.0, 2.25}), Outcome::kHit);
  EXPECT_EQ(OutcomeAt({0.0, 0.0, std::nextafter(2.25, 3.0)}), Outcome::kGross);
  EXPECT_EQ(OutcomeAt({0.25, 0.0, 2.0}), Outcome::kHit);
  EXPECT_EQ(OutcomeAt({std::nextafter(0.25, 1.0), 0.0, 2.0}), Outcome::kGross);
}

TEST(Scoring, TheErrorIsThreeDimensional) {
  // √3 · 0.15 = 0.2598 > 0.25, although no axis is off by that much.
  EXPECT_EQ(OutcomeAt({0.15, 0.15, 2.15}), Outcome::kGross);
  EXPECT_EQ(OutcomeAt({0.14, 0.14, 2.14}), Outcome::kHit);
}

TEST(Scoring, TheSmallerSideCounts) {
  for (const auto& [width_m, height_m] : {std::pair(4.0, 1.0), std::pair(1.0, 4.0)}) {
    const GroundTruth truth = Scene(Window({0.0, 0.0, 2.0}, width_m, height_m));
    EXPECT_EQ(OutcomeAt({0.25, 0.0, 2.0}, truth), Outcome::kHit);
    EXPECT_EQ(OutcomeAt({0.26, 0.0, 2.0}, truth), Outcome::kGross);
  }
}

TEST(Scoring, AnotherWindowIsWrongOnlyWithinItsOwnTolerance) {
  const GroundTruth truth =
      Scene(Window({0.0, 0.0, 2.0}), {Window({2.0, 0.0, 2.0}, 0.4, 0.4), Window({9.0, 0.0, 2.0})});
  EXPECT_EQ(OutcomeAt({2.0, 0.0, 2.0}, truth), Outcome::kWrongWindow);
  EXPECT_EQ(OutcomeAt({2.09, 0.0, 2.0}, truth), Outcome::kWrongWindow);
  EXPECT_EQ(OutcomeAt({2.11, 0.0, 2.0}, truth), Outcome::kGross);
  EXPECT_EQ(OutcomeAt({0.1, 0.0, 2.0}, truth), Outcome::kHit);
}

TEST(Scoring, TheNearerOfTwoOverlappingWindowsDecides) {
  // The midpoint at x = 0.125 is as near to both: only the nearer one can be wrong.
  const GroundTruth truth = Scene(Window({0.0, 0.0, 2.0}), {Window({0.25, 0.0, 2.0})});
  EXPECT_EQ(OutcomeAt({0.125, 0.0, 2.0}, truth), Outcome::kHit);
  EXPECT_EQ(OutcomeAt({std::nextafter(0.125, 1.0), 0.0, 2.0}, truth), Outcome::kWrongWindow);
}

TEST(Scoring, NonsenseIsACrashAndIsNotKept) {
  std::vector<WindowEstimate> estimates(8, EstimateAt({0.0, 0.0, 2.0}));
  estimates[0].p_CO.x() = kNaN;
  estimates[1].p_CO.z() = kInfinity;
  estimates[2].p_CO.z() = 0.0;
  estimates[3].p_CO.z() = -2.0;
  estimates[4].p_CV[3].y() = kNaN;
  estimates[5].p_CV[0].z() = -1e-9;
  estimates[6].normal_C.x() = kNaN;
  estimates[7].covariance_C = Eigen::Matrix3d::Constant(kInfinity);
  for (size_t i = 0; i < estimates.size(); ++i) {
    const Score score = ScoreDetection(Detection(estimates[i]), kTargetAhead);
    EXPECT_EQ(score.outcome, Outcome::kCrashed) << i;
    EXPECT_EQ(score.reason, "nonsense") << i;
    EXPECT_FALSE(score.detail.empty()) << i;
    EXPECT_FALSE(score.estimate.has_value()) << i;
    EXPECT_FALSE(score.CentroidError_C().has_value()) << i;
  }
}

TEST(Scoring, MissesAndCrashesKeepTheirReasons) {
  const Score missed = ScoreDetection(Detection(Miss{"no_contour", "3 of 4"}), kTargetAhead);
  EXPECT_EQ(missed.outcome, Outcome::kMissed);
  EXPECT_EQ(missed.reason, "no_contour");
  EXPECT_EQ(missed.detail, "3 of 4");
  const Score crashed = ScoreDetection(Crash{"exception", "bad_alloc"}, kTargetAhead);
  EXPECT_EQ(crashed.outcome, Outcome::kCrashed);
  EXPECT_EQ(crashed.reason, "exception");
  EXPECT_EQ(crashed.detail, "bad_alloc");
  EXPECT_EQ(crashed.truth_p_CO, Eigen::Vector3d(0.0, 0.0, 2.0));
}

TEST(Scoring, ATargetOutOfViewCountsApartWhateverTheAnswer) {
  GroundTruth truth = kTargetAhead;
  truth.in_view = false;
  const Score found = ScoreDetection(Detection(EstimateAt({0.0, 0.0, 2.1})), truth);
  EXPECT_EQ(found.outcome, Outcome::kOutOfView);
  ASSERT_TRUE(found.CentroidError_C().has_value());
  EXPECT_EQ(*found.CentroidError_C(), Eigen::Vector3d(0.0, 0.0, 2.1 - 2.0));
  const Score missed = ScoreDetection(Detection(Miss{"no_contour", ""}), truth);
  EXPECT_EQ(missed.outcome, Outcome::kOutOfView);
  EXPECT_EQ(missed.reason, "no_contour");
  const Score crashed = ScoreDetection(Crash{"timeout", ""}, truth);
  EXPECT_EQ(crashed.outcome, Outcome::kOutOfView);
  EXPECT_EQ(crashed.reason, "timeout");
}

TEST(Scoring, WithoutATargetThereAreFalseAlarmsClearScenesAndCrashes) {
  // Even where another window is found: none was to be found.
  GroundTruth empty = Scene(std::nullopt, {Window({0.0, 0.0, 2.0})});
  empty.in_view = false;
  const Score alarm = ScoreDetection(Detection(EstimateAt({0.0, 0.0, 2.0})), empty);
  EXPECT_EQ(alarm.outcome, Outcome::kFalseAlarm);
  EXPECT_TRUE(alarm.estimate.has_value());
  EXPECT_FALSE(alarm.CentroidError_C().has_value());
  EXPECT_EQ(ScoreDetection(Detection(Miss{"none", ""}), empty).outcome, Outcome::kClear);
  EXPECT_EQ(ScoreDetection(Crash{"exception", ""}, empty).outcome, Outcome::kCrashed);
}

TEST(Scoring, OutcomesReadBackFromTheirNames) {
  for (const Outcome outcome : kAllOutcomes) {
    EXPECT_EQ(ParseOutcome(ToString(outcome)), outcome);
    EXPECT_NE(std::string(OutcomeDefinition(outcome)), "");
  }
  EXPECT_EQ(ParseOutcome("Hit"), std::nullopt);
}

TEST(Scoring, AnInputErrorOfAnOwnDetectorPassesAndThatOfAnotherIsItsCrash) {
  const auto refuse = []() -> Detection { throw InputError("left image", "is too small"); };
  EXPECT_THROW(DetectionOrCrash(refuse, true), InputError);
  EXPECT_EQ(std::get<Crash>(DetectionOrCrash(refuse)).detail, "left image: is too small");
  const auto fail = []() -> Detection { throw std::out_of_range("vector"); };
  EXPECT_EQ(std::get<Crash>(DetectionOrCrash(fail, true)).kind, "exception");
}

}  // namespace
}  // namespace fenestra
