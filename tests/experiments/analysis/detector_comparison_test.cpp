#include "experiments/analysis/detector_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random/random_stream.h"
#include "experiments/report/detector_comparison_report.h"

namespace fenestra {
namespace {

TrialRecord Record(int trial, const std::string& detector, Outcome outcome, double error_m) {
  TrialRecord record;
  record.trial = trial;
  record.part = "main";
  record.detector = detector;
  record.score.outcome = outcome;
  record.score.truth_p_CO = Eigen::Vector3d(0, 0, 3);
  if (outcome == Outcome::kHit) {
    WindowEstimate estimate;
    estimate.p_CO = Eigen::Vector3d(0, error_m, 3);
    record.score.estimate = estimate;
  }
  return record;
}

// Errors that two detectors share but for what each does by itself; the second's are `ratio` of the
// first's.
std::vector<DetectorComparison> Compared(int trials, double ratio, uint64_t seed) {
  DetectorComparisons comparisons;
  const RandomStream stream(seed);
  for (int i = 0; i < trials; ++i) {
    const double hard = std::exp(0.5 * stream.Normal(static_cast<uint64_t>(i)));
    const auto own = [&](const char* who) {
      return 1e-2 * hard * std::exp(0.1 * stream.Child(who).Normal(static_cast<uint64_t>(i)));
    };
    comparisons.Add(Record(i, "b", Outcome::kHit, ratio * own("b")));
    comparisons.Add(Record(i, "a", Outcome::kHit, own("a")));
  }
  return comparisons.Comparisons();
}

TEST(DetectorComparison, SeesASmallDifferenceThatTrialsHaveInCommon) {
  int found = 0;
  int imagined = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    found += Compared(60, 1.2, seed).front().errors.sign_test_p < 0.05 ? 1 : 0;
    imagined += Compared(60, 1.0, seed).front().errors.sign_test_p < 0.05 ? 1 : 0;
  }
  // 20 % are ln 1.2 = 0.18 against a spread of 0.14 in the difference: nearly every pair tells.
  EXPECT_GE(found, 195);
  // Of equal detectors no more than 10 of 200 are expected; standard deviation 3.1; four: 3e-5.
  EXPECT_LE(imagined, 22);
}

TEST(DetectorComparison, PairsTrialsWhateverTheOrder) {
  DetectorComparisons comparisons;
  comparisons.Add(Record(0, "b", Outcome::kHit, 0.01));
  comparisons.Add(Record(1, "a", Outcome::kMissed, 0.0));
  comparisons.Add(Record(0, "a", Outcome::kHit, 0.03));
  comparisons.Add(Record(1, "b", Outcome::kHit, 0.01));
  comparisons.Add(Record(2, "a", Outcome::kOutOfView, 0.0));
  comparisons.Add(Record(2, "b", Outcome::kOutOfView, 0.0));
  comparisons.Add(Record(3, "a", Outcome::kHit, 0.01));  // Not tried by b.
  const auto all = comparisons.Comparisons();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].first, "a");
  EXPECT_EQ(all[0].successes.pairs(), 2);
  EXPECT_EQ(all[0].successes.both, 1);
  EXPECT_EQ(all[0].successes.only_second, 1);
  EXPECT_EQ(all[0].errors.second_nearer, 2);
  EXPECT_EQ(all[0].errors.both_finite, 1);
  EXPECT_THAT(ComparisonMarkdown(all), ::testing::HasSubstr("a − b"));
  EXPECT_THAT(ComparisonMarkdown(all), ::testing::HasSubstr("0 : 2"));
}

TEST(DetectorComparison, InScenesWithoutAWindowClearIsSuccess) {
  DetectorComparisons comparisons;
  for (const auto& [detector, outcome] :
       {std::pair("a", Outcome::kClear), std::pair("b", Outcome::kFalseAlarm)}) {
    TrialRecord record = Record(0, detector, outcome, 0.0);
    record.score.truth_p_CO.reset();
    comparisons.Add(record);
  }
  const auto all = comparisons.Comparisons();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].successes.only_first, 1);
  EXPECT_EQ(all[0].errors.pairs, 0);
}

TEST(DetectorComparison, OneDetectorIsNotCompared) {
  DetectorComparisons comparisons;
  comparisons.Add(Record(0, "a", Outcome::kHit, 0.01));
  EXPECT_TRUE(comparisons.Comparisons().empty());
  EXPECT_EQ(ComparisonMarkdown({}), "");
}

}  // namespace
}  // namespace fenestra
