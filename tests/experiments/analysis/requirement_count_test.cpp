#include "experiments/analysis/requirement_count.h"

#include <gtest/gtest.h>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

TrialRecord Hit(double error_m) {
  TrialRecord record;
  record.score.outcome = Outcome::kHit;
  record.score.truth_p_CO = Eigen::Vector3d(0, 0, 3);
  WindowEstimate estimate;
  estimate.p_CO = Eigen::Vector3d(0, 0, 3 + error_m);
  record.score.estimate = estimate;
  return record;
}

TrialRecord Missed() {
  TrialRecord record;
  record.score.outcome = Outcome::kMissed;
  record.score.truth_p_CO = Eigen::Vector3d(0, 0, 3);
  return record;
}

// Rows are told apart by their trials.
MetricRow Of(TrialRecord record) {
  static int trial = 0;
  record.trial = trial++;
  return RowContext().Of(record);
}

const EnvelopeRule kRule{.over = "distance_m",
                         .require = {{"hit_rate", 0.95}, {"p95_error_mm", 50.0}},
                         .confidence = 0.95};

RequirementCount After(int hits, int misses, double error_m = 0.01) {
  RequirementCount count(kRule);
  for (int i = 0; i < hits; ++i) count.Add(Of(Hit(error_m)));
  for (int i = 0; i < misses; ++i) count.Add(Of(Missed()));
  return count;
}

// 0.95^59 = 4.85 %, 0.95^58 = 5.1 %: it takes 59 good attempts without a miss.
TEST(RequirementCount, HoldsFromTheTextbooksNumberOfTrialsOn) {
  EXPECT_EQ(After(58, 0).verdict(), Verdict::kUndecided);
  EXPECT_EQ(After(59, 0).verdict(), Verdict::kHolds);
  EXPECT_EQ(After(60, 1).verdict(), Verdict::kUndecided);
  EXPECT_EQ(After(50, 10).verdict(), Verdict::kViolated);
  EXPECT_EQ(After(200, 0, 0.06).verdict(),
            Verdict::kViolated);  // Hits, but not near enough.
}

TEST(RequirementCount, CanNoLongerHoldOnceTooMuchIsLost) {
  EXPECT_TRUE(After(10, 0).CanHoldAfter(49));
  EXPECT_FALSE(After(10, 0).CanHoldAfter(48));
  EXPECT_FALSE(After(9, 1).CanHoldAfter(59));
  EXPECT_TRUE(After(9, 1).CanHoldAfter(100));
}

TEST(RequirementCount, OutOfViewIsNoAttempt) {
  RequirementCount count = After(59, 0);
  TrialRecord out = Missed();
  out.score.outcome = Outcome::kOutOfView;
  count.Add(Of(out));
  EXPECT_EQ(count.trials(), 60);
  EXPECT_EQ(count.attempts(), 59);
  EXPECT_EQ(count.verdict(), Verdict::kHolds);
}

// A detector that misses the requirement by nothing is passed in no more than 5 % of cells.
TEST(RequirementCount, ClaimsTooMuchNoMoreOftenThanItSays) {
  constexpr int kRuns = 2000;
  int claimed = 0;
  int naive = 0;
  for (uint64_t run = 0; run < kRuns; ++run) {
    RequirementCount count(kRule);
    int good = 0;
    for (uint64_t i = 0; i < 100; ++i) {
      const bool hit = RandomStream(run).Uniform(i) < 0.95;
      good += hit ? 1 : 0;
      count.Add(Of(hit ? Hit(0.01) : Missed()));
    }
    claimed += count.verdict() == Verdict::kHolds ? 1 : 0;
    naive += good >= 95 ? 1 : 0;
  }
  // At most 100 expected; standard deviation 9.7; four: 3e-5.
  EXPECT_LE(claimed, 139);
  EXPECT_GE(naive, 1000);  // The twin, which takes the sample's share for the truth.
}

}  // namespace
}  // namespace fenestra
