#include "experiments/analysis/confidence_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

MetricRow HitRow(int trial, const Eigen::Vector3d& error_C) {
  return {.outcome = Outcome::kHit,
          .has_target = true,
          .cluster = {.replicate = trial},
          .error_C = error_C};
}

MetricTally Mixed(int hits, int misses) {
  MetricTally tally;
  for (int i = 0; i < hits; ++i) tally.Add(HitRow(i, {0, 0, 0.010}));
  for (int i = 0; i < misses; ++i) {
    tally.Add(
        {.outcome = Outcome::kMissed, .has_target = true, .cluster = {.replicate = hits + i}});
  }
  return tally;
}

ConfidenceLimits Against(const MetricTally& tally, const char* name, double value, bool is_upper) {
  return LimitsOf(tally, {*FindMetric(name), value, is_upper}).value();
}

// 0.95^59 = 4.85 %, 0.95^58 = 5.1 %: it takes 59 hits without a miss.
TEST(ConfidenceLimits, HoldFromTheTextbooksNumberOfTrialsOn) {
  EXPECT_FALSE(Against(Mixed(58, 0), "hit_rate", 0.95, false).Holds(0.95));
  EXPECT_TRUE(Against(Mixed(59, 0), "hit_rate", 0.95, false).Holds(0.95));
  EXPECT_TRUE(Against(Mixed(59, 0), "p95_error_mm", 10.0, true).Holds(0.95));
  EXPECT_FALSE(Against(Mixed(59, 0), "p95_error_mm", 9.9, true).Holds(0.95));
  EXPECT_TRUE(Against(Mixed(59, 0), "p95_error_mm", 9.9, true).IsViolated(0.05));
  EXPECT_TRUE(Against(Mixed(50, 10), "hit_rate", 0.95, false).IsViolated(0.05));
}

TEST(ConfidenceLimits, OfAQuantileAreThoseOfTheShareWithin) {
  const ConfidenceLimits limits = Against(Mixed(90, 10), "p50_error_mm", 20.0, true);
  EXPECT_EQ(limits.limit, 0.5);
  EXPECT_FALSE(limits.is_upper);
  EXPECT_EQ(limits.share->successes, 90.0);
  EXPECT_EQ(limits.share->trials, 100.0);
  EXPECT_EQ(limits.clusters, 100);
}

TEST(ConfidenceLimits, WithoutARowThatCountsThereAreNone) {
  EXPECT_FALSE(LimitsOf(Mixed(0, 5), {*FindMetric("rmse_mm"), 1.0, true}).has_value());
}

// Hits of which one in fifty is twenty times as far off as the others: of 200 rows the far ones
// hold nine tenths of the mean square, and how many there are is a matter of luck.
MetricTally HeavyTailed(uint64_t run, int rows) {
  MetricTally tally;
  const RandomStream stream = RandomStream(17).Child("run", run);
  for (int i = 0; i < rows; ++i) {
    const RandomStream own = stream.Child("row", static_cast<uint64_t>(i));
    const double sigma_m = own.Uniform(3) < 0.02 ? 0.2 : 0.01;
    tally.Add(HitRow(i, sigma_m * Eigen::Vector3d(own.Normal(0), own.Normal(1), own.Normal(2))));
  }
  return tally;
}

constexpr int kLimitedStudies = 1000;

// How often a limit that the metric only just does not meet is said to hold.
double WronglyHeld(const char* name, double truth) {
  int held = 0;
  for (uint64_t run = 0; run < kLimitedStudies; ++run) {
    held += Against(HeavyTailed(run, 200), name, truth, true).Holds(0.95) ? 1 : 0;
  }
  return static_cast<double>(held) / kLimitedStudies;
}

TEST(ConfidenceLimits, OfATrimmedRmseHoldWithHeavyTailsNoMoreOftenThanStated) {
  // The truth by a sample so large that its own error, 0.1 %, is a fiftieth of that of 200 rows.
  const double trimmed =
      HeavyTailed(kLimitedStudies, 400'000).Estimate(*FindMetric("trimmed_rmse_mm"))->value;
  // 5 % and four standard deviations, a false alarm of 3e-5, and 1 % for what is of first order.
  const double limit = 0.05 + 0.01 + 4.0 * std::sqrt(0.05 * 0.95 / kLimitedStudies);
  EXPECT_LE(WronglyHeld("trimmed_rmse_mm", trimmed), limit);
  // The twin: of an rmse of the same rows a limit holds wrongly far more often. 0.98 + 0.02 · 20².
  EXPECT_GT(WronglyHeld("rmse_mm", 10.0 * std::sqrt(3.0 * (0.98 + 8.0))), limit);
}

TEST(ConfidenceLimits, SayHowMuchOfAnRmseTheLargestRowHolds) {
  MetricTally tally;
  for (int i = 0; i < 99; ++i) tally.Add(HitRow(i, {0, 0, 0.010}));
  EXPECT_NEAR(*Against(tally, "rmse_mm", 20.0, true).largest_share, 1.0 / 99.0, 1e-12);
  tally.Add(HitRow(99, {0, 0, 0.100}));  // 100 of 199 squares of 10 mm.
  EXPECT_NEAR(*Against(tally, "rmse_mm", 20.0, true).largest_share, 100.0 / 199.0, 1e-12);
  EXPECT_FALSE(Against(tally, "trimmed_rmse_mm", 20.0, true).largest_share.has_value());
}

}  // namespace
}  // namespace fenestra
