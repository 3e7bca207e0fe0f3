#include "experiments/check/limit_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/io/input_error.h"
#include "experiments/check/limit_text.h"
#include "tests/experiments/check/simulated_rows.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using testing::Row;
using testing::RowWithError;
using testing::SimulatedRows;
using testing::StudyOfThreeDistances;

LimitFile FileOf(const std::vector<std::string>& texts, double false_alarm = 0.05) {
  LimitFile file{.study = "", .false_alarm = false_alarm, .limits = {}};
  for (const std::string& text : texts) file.limits.push_back(ParseLimit(text, 0.95));
  return file;
}

CheckResult Check(const std::vector<std::string>& texts, const std::vector<TrialRecord>& rows,
                  double false_alarm = 0.05) {
  static const Study kStudy = StudyOfThreeDistances(100);
  return CheckLimits("limits.yaml", FileOf(texts, false_alarm), kStudy, rows, {});
}

Verdict VerdictOf(const std::string& text, const std::vector<TrialRecord>& rows) {
  return Check({text}, rows).limits.front().verdict;
}

TEST(CheckLimits, SaysWhatIsWithinBeyondAndNear) {
  const auto rows = SimulatedRows({}, 3, 100, RandomStream(1));
  // Of |N(0, 10² I₃)| the 95th percentile over all attempts with 5 % misses is infinite, that of
  // the 0.8-quantile about 22 mm; RMSE 17.3 mm; hit rate 0.95.
  EXPECT_EQ(VerdictOf("p80(centroid_error_mm) <= 30", rows), Verdict::kHolds);
  EXPECT_EQ(VerdictOf("p80(centroid_error_mm) <= 15", rows), Verdict::kViolated);
  EXPECT_EQ(VerdictOf("p80(centroid_error_mm) >= 15", rows), Verdict::kHolds);
  EXPECT_EQ(VerdictOf("p80(centroid_error_mm) >= 30", rows), Verdict::kViolated);
  EXPECT_EQ(VerdictOf("rmse(centroid_error_mm) <= 20", rows), Verdict::kHolds);
  EXPECT_EQ(VerdictOf("rmse(centroid_error_mm) <= 17.3", rows), Verdict::kUndecided);
  EXPECT_EQ(VerdictOf("rmse(centroid_error_mm) <= 15", rows), Verdict::kViolated);
  EXPECT_EQ(VerdictOf("bias(centroid_error_z_mm) <= 3", rows), Verdict::kHolds);
  EXPECT_EQ(VerdictOf("bias(centroid_error_z_mm) <= -3", rows), Verdict::kViolated);
  EXPECT_EQ(VerdictOf("rate(hit) >= 0.9", rows), Verdict::kHolds);
  EXPECT_EQ(VerdictOf("rate(hit) >= 0.95", rows), Verdict::kUndecided);
  EXPECT_EQ(VerdictOf("rate(hit) >= 0.995", rows), Verdict::kViolated);
  EXPECT_EQ(VerdictOf("rate(missed) <= 0.005", rows), Verdict::kViolated);
}

TEST(CheckLimits, AMissCountsAsAnInfiniteError) {
  std::vector<TrialRecord> rows;
  for (int i = 0; i < 200; ++i) {
    rows.push_back(i % 10 == 0 ? Row(0, i, Outcome::kMissed)
                               : RowWithError(0, i, Outcome::kHit, {0.001, 0.0, 0.0}));
  }
  EXPECT_EQ(VerdictOf("p85(centroid_error_mm) <= 2", rows), Verdict::kHolds);
  EXPECT_EQ(VerdictOf("p99(centroid_error_mm) <= 1000", rows), Verdict::kViolated);
  EXPECT_EQ(VerdictOf("rmse(centroid_error_mm) <= 2", rows), Verdict::kHolds);  // Over hits.
}

TEST(CheckLimits, FalseAlarmsAreRatesOfEmptyScenes) {
  std::vector<TrialRecord> rows;
  for (int i = 0; i < 100; ++i) rows.push_back(Row(0, i, Outcome::kHit));
  for (int i = 100; i < 200; ++i) {
    rows.push_back(Row(0, i, i < 110 ? Outcome::kFalseAlarm : Outcome::kClear));
  }
  const LimitResult result = Check({"rate(false_alarm) <= 0.2"}, rows).limits.front();
  EXPECT_EQ(result.rows, 100);
  EXPECT_EQ(result.measured, "10.0 %");
  EXPECT_EQ(result.verdict, Verdict::kHolds);
}

TEST(CheckLimits, SelectsByLevelDrawnAndFixedFactors) {
  auto rows = SimulatedRows({}, 3, 10, RandomStream(2));
  for (TrialRecord& row : rows) row.drawn = {{"yaw_deg", row.trial < 4 ? -1.0 : 1.0}};
  const auto rows_of = [&rows](const std::string& where) {
    return Check({"rate(hit) >= 0.5 where " + where}, rows).limits.front().rows;
  };
  EXPECT_EQ(rows_of("distance_m <= 3"), 20);
  EXPECT_EQ(rows_of("distance_m in [2, 4]"), 20);
  EXPECT_EQ(rows_of("distance_m != 3 and yaw_deg < 0"), 8);
  EXPECT_EQ(rows_of("sky_illuminance_lx > 0"), 30);  // Fixed by the study.
  EXPECT_EQ(rows_of("detector = a and sensor = stereo and part = window"), 30);
}

TEST(CheckLimits, InEachCellEveryCellIsALimit) {
  const auto rows = SimulatedRows({}, 3, 50, RandomStream(3));
  const CheckResult result = Check({"rate(hit) >= 0.5 in each cell"}, rows);
  ASSERT_EQ(result.limits.size(), 3u);
  EXPECT_EQ(result.limits[1].cell, "cell 1 (window, distance_m = 3)");
  EXPECT_DOUBLE_EQ(result.test_level, 0.05 / 3.0);
}

TEST(CheckLimits, SaysHowManyReplicatesWouldDecide) {
  // 190 of 200 within: 0.95, held against 0.93. One-sided Clopper-Pearson at 95 % reaches it with
  // 0.95 - 1.64 √(0.95 0.05/n) ≈ 0.93, n ≈ 321 to first order; the exact limit needs more, by
  // about 1/√n.
  std::vector<TrialRecord> rows;
  for (int i = 0; i < 200; ++i)
    rows.push_back(Row(0, i, i < 190 ? Outcome::kHit : Outcome::kGross));
  const LimitResult result = Check({"rate(hit) >= 0.93"}, rows).limits.front();
  ASSERT_TRUE(result.replicates_to_decide);
  EXPECT_GT(*result.replicates_to_decide, 321);
  EXPECT_LT(*result.replicates_to_decide, 500);
  // With so many, it is decided.
  const long n = *result.replicates_to_decide + 60;
  for (long i = 200; i < n; ++i) {
    rows.push_back(Row(0, static_cast<int>(i), i % 20 != 19 ? Outcome::kHit : Outcome::kGross));
  }
  EXPECT_EQ(VerdictOf("rate(hit) >= 0.93", rows), Verdict::kHolds);
  EXPECT_FALSE(Check({"rate(hit) >= 0.95"}, rows).limits.front().replicates_to_decide.has_value() &&
               *Check({"rate(hit) >= 0.95"}, rows).limits.front().replicates_to_decide < 10000);
}

TEST(CheckLimits, WhatSelectsNothingIsAnInputError) {
  const auto rows = SimulatedRows({}, 3, 5, RandomStream(4));
  const auto fault = [&rows](const std::string& text) -> std::string {
    try {
      Check({text}, rows);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(fault("rate(hit) >= 0.5 where distance_m > 9"), HasSubstr("no trial"));
  EXPECT_THAT(fault("rate(hit) >= 0.5 where detector = b"), HasSubstr("no detector 'b'"));
  EXPECT_THAT(fault("rate(hit) >= 0.5 where rgbd_depth_model = speckle"), HasSubstr("no effect"));
  EXPECT_THAT(fault("rate(hit) >= baseline"), HasSubstr("--baseline"));
}

TEST(CheckLimits, WithoutARowThatCountsNothingIsDecided) {
  const auto rows = SimulatedRows({.hit_rate = 0.0}, 1, 20, RandomStream(5));
  const LimitResult result = Check({"rmse(centroid_error_mm) <= 1"}, rows).limits.front();
  EXPECT_EQ(result.verdict, Verdict::kUndecided);
  EXPECT_EQ(result.rows, 0);
}

// Limits that hold with nothing to spare, for SimulatedRows' default law: σ = 10 mm, 5 % misses.
// The 0.95-quantile of a χ² with 3 degrees of freedom is 7.814727903, and 0.95 · 0.95 = 0.9025.
const std::vector<std::string> kTightLimits = {
    "p90.25(centroid_error_mm) <= 27.95483",
    "rate(hit) >= 0.95",
    "rate(missed) <= 0.05",
    "rmse(centroid_error_mm) <= 17.320508",
    "bias(centroid_error_z_mm) <= 0",
    "bias(centroid_error_x_mm) >= 0",
};
constexpr int kCheckedStudies = 400;
constexpr double kFalseAlarm = 0.2;  // So large that so many runs can tell.

// Share of simulated studies in which one of the limits is called violated.
double ViolationRate(bool all_in_one_file) {
  int runs_with_violation = 0;
  for (uint64_t run = 0; run < kCheckedStudies; ++run) {
    const auto rows = SimulatedRows({}, 3, 40, RandomStream(6).Child("run", run));
    int violated = 0;
    if (all_in_one_file) {
      violated = Check(kTightLimits, rows, kFalseAlarm).Count(Verdict::kViolated);
    } else {
      for (const std::string& limit : kTightLimits) {
        violated += Check({limit}, rows, kFalseAlarm).Count(Verdict::kViolated);
      }
    }
    runs_with_violation += violated > 0 ? 1 : 0;
  }
  return static_cast<double>(runs_with_violation) / kCheckedStudies;
}

TEST(CheckLimits, CallsAFileViolatedNoMoreOftenThanStated) {
  // 4 sigma of a share of 20 % in 400 runs.
  const double limit =
      kFalseAlarm + 4.0 * std::sqrt(kFalseAlarm * (1.0 - kFalseAlarm) / kCheckedStudies);
  EXPECT_LE(ViolationRate(true), limit);
  EXPECT_GT(ViolationRate(false), limit);  // Each at the level of the whole file.
}

TEST(CheckLimits, SaysHoldsOfABrokenLimitNoMoreOftenThanItsConfidenceAllows) {
  // The same limits with nothing to spare: one more millionth and they do not hold.
  for (const std::string& limit : kTightLimits) {
    int held = 0;
    for (uint64_t run = 0; run < kCheckedStudies; ++run) {
      const auto rows = SimulatedRows({}, 3, 40, RandomStream(7).Child("run", run));
      held += VerdictOf(limit, rows) == Verdict::kHolds ? 1 : 0;
    }
    EXPECT_LE(held, kCheckedStudies * 0.05 + 4.0 * std::sqrt(kCheckedStudies * 0.05 * 0.95))
        << limit;
  }
}

}  // namespace
}  // namespace fenestra
