#include "experiments/check/regression.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/io/input_error.h"
#include "experiments/check/limit_check.h"
#include "experiments/check/limit_text.h"
#include "tests/experiments/check/simulated_rows.h"

namespace fenestra {
namespace {

using testing::RowLaw;
using testing::SimulatedRows;
using testing::StudyOfThreeDistances;

CheckResult Compare(const std::vector<TrialRecord>& now, const std::vector<TrialRecord>& before) {
  static const Study kStudy = StudyOfThreeDistances(100);
  return CheckLimits("limits.yaml", {}, kStudy, now, before);
}

std::vector<TrialRecord> Rows(const RowLaw& law, uint64_t luck, int cells = 1, int trials = 200) {
  return SimulatedRows(law, cells, trials, RandomStream(11).Child("luck", luck));
}

TEST(Regression, TheSameRowsHold) {
  const auto rows = Rows({}, 0);
  const CheckResult result = Compare(rows, rows);
  ASSERT_EQ(result.limits.size(), 2u);
  EXPECT_EQ(result.Count(Verdict::kHolds), 2);
  EXPECT_EQ(result.limits.front().note, "the same in every trial");
}

TEST(Regression, AFifthMoreErrorIsFoundInTwoHundredTrials) {
  // Even where the detectors share no luck at all; with shared luck far fewer trials do.
  int found = 0;
  constexpr int kRuns = 100;
  for (uint64_t run = 0; run < kRuns; ++run) {
    const CheckResult result = Compare(Rows({.sigma_mm = 12.0, .hit_rate = 1.0}, 2 * run + 1),
                                       Rows({.hit_rate = 1.0}, 2 * run));
    found += result.limits.front().verdict == Verdict::kViolated ? 1 : 0;
  }
  EXPECT_GE(found, 95);
  const CheckResult paired = Compare(Rows({.sigma_mm = 12.0}, 0, 1, 10), Rows({}, 0, 1, 10));
  EXPECT_EQ(paired.limits.front().verdict, Verdict::kViolated);
}

TEST(Regression, DetectorsThatAreEquallyGoodAreRarelyCalledWorse) {
  int alarms = 0;
  constexpr int kRuns = 200;
  for (uint64_t run = 0; run < kRuns; ++run) {
    const CheckResult result = Compare(Rows({}, 2 * run + 1, 3, 30), Rows({}, 2 * run, 3, 30));
    alarms += result.Count(Verdict::kViolated) > 0 ? 1 : 0;
  }
  // False alarm 0.05 over both tests; 4 sigma.
  EXPECT_LE(alarms, kRuns * 0.05 + 4.0 * std::sqrt(kRuns * 0.05 * 0.95));
}

TEST(Regression, LostHitsAreFound) {
  const CheckResult result = Compare(Rows({.hit_rate = 0.85}, 0), Rows({.hit_rate = 0.95}, 0));
  EXPECT_EQ(result.limits[1].verdict, Verdict::kViolated);
}

TEST(Regression, ABaselineOfAnotherStudyIsRefused) {
  EXPECT_THROW(Compare(Rows({}, 0, 2), Rows({}, 0, 1)), InputError);
  EXPECT_THROW(Compare(Rows({}, 0, 1, 20), Rows({}, 0, 1, 10)), InputError);
}

TEST(Regression, LimitsMayNameTheBaseline) {
  static const Study kStudy = StudyOfThreeDistances(100);
  LimitFile file;
  for (const char* text :
       {"rmse(centroid_error_mm) <= 1.3 times baseline",
        "rmse(centroid_error_mm) <= 1.1 times baseline", "rate(hit) >= baseline - 0.05"}) {
    file.limits.push_back(ParseLimit(text, 0.95));
  }
  const auto now = Rows({.sigma_mm = 12.0}, 0);
  const CheckResult result = CheckLimits("limits.yaml", file, kStudy, now, Rows({}, 0));
  EXPECT_EQ(result.limits[0].verdict, Verdict::kHolds);
  EXPECT_EQ(result.limits[1].verdict, Verdict::kViolated);
  EXPECT_EQ(result.limits[2].verdict, Verdict::kHolds);
  EXPECT_EQ(result.limits[0].measured, "1.20 times");
}

}  // namespace
}  // namespace fenestra
