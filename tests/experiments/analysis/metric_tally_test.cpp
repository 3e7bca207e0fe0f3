#include "experiments/analysis/metric_tally.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/random/random_stream.h"
#include "experiments/analysis/confidence_limits.h"
#include "experiments/statistics/clustered_intervals.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

constexpr double kInfiniteValue = std::numeric_limits<double>::infinity();

MetricRow Hit(int trial, const Eigen::Vector3d& error_C) {
  return {.outcome = Outcome::kHit,
          .has_target = true,
          .cluster = {.replicate = trial},
          .error_C = error_C,
          .side_m = 1.0};
}

MetricRow Without(int trial, Outcome outcome) {
  return {.outcome = outcome, .has_target = true, .cluster = {.replicate = trial}, .side_m = 1.0};
}

MetricRow Empty(int trial, Outcome outcome) {
  return {.outcome = outcome, .has_target = false, .cluster = {.replicate = trial}};
}

MetricEstimate Of(const MetricTally& tally, const char* name, double confidence = 0.95) {
  const auto estimate = tally.Estimate(FindMetric(name).value(), confidence);
  EXPECT_TRUE(estimate.has_value()) << name;
  return estimate.value_or(MetricEstimate{});
}

TEST(MetricTally, EveryRateHasItsDenominator) {
  MetricTally tally;
  for (int i = 0; i < 6; ++i) tally.Add(Hit(i, {0.001 * i, 0, 0.01}));
  MetricRow gross = Hit(6, {0, 0, 1});
  gross.outcome = Outcome::kGross;
  tally.Add(gross);
  tally.Add(Without(7, Outcome::kMissed));
  tally.Add(Without(8, Outcome::kOutOfView));
  tally.Add(Empty(9, Outcome::kFalseAlarm));
  tally.Add(Empty(10, Outcome::kClear));
  const auto expect = [&](const char* name, int count, int of) {
    const MetricEstimate estimate = Of(tally, name);
    EXPECT_EQ(estimate.count, count) << name;
    EXPECT_EQ(estimate.of, of) << name;
    EXPECT_EQ(estimate.value, static_cast<double>(count) / of) << name;
    // The textbook's, to the last bit.
    EXPECT_EQ(estimate.interval->lower, ClopperPearson(count, of).lower) << name;
    EXPECT_EQ(estimate.interval->upper, ClopperPearson(count, of).upper) << name;
    EXPECT_EQ(estimate.method, "Clopper-Pearson");
  };
  expect("hit_rate", 6, 8);
  expect("gross_rate", 1, 8);
  expect("wrong_window_rate", 0, 8);
  expect("missed_rate", 1, 8);
  expect("crashed_rate", 0, 8);
  expect("out_of_view_rate", 1, 9);
  expect("false_alarm_rate", 1, 2);
  expect("clear_rate", 1, 2);
}

TEST(MetricTally, IndependentRowsHaveTheIntervalsOfTheTextbook) {
  MetricTally tally;
  std::vector<double> z;
  std::vector<double> lengths;
  for (int i = 0; i < 30; ++i) {
    const RandomStream stream = RandomStream(1).Child("row", static_cast<uint64_t>(i));
    const Eigen::Vector3d e(stream.Normal(0), stream.Normal(1), stream.Normal(2));
    tally.Add(Hit(i, e));
    z.push_back(e.z());
    lengths.push_back(e.norm());
  }
  const auto expect = [&](const char* name, const std::optional<Interval>& metres) {
    const Interval interval = Of(tally, name).interval.value();
    EXPECT_EQ(interval.lower, 1e3 * metres->lower) << name;
    EXPECT_EQ(interval.upper, 1e3 * metres->upper) << name;
  };
  expect("bias_z_mm", MeanInterval(z));
  expect("p50_error_mm", QuantileInterval(lengths, 0.5));
  expect("rmse_mm", RootMeanSquareInterval(lengths, RandomStream(0).Child("rms_interval")));
  EXPECT_EQ(Of(tally, "bias_z_mm").value, 1e3 * Mean(z));
  EXPECT_EQ(Of(tally, "rmse_mm").value, 1e3 * RootMeanSquare(lengths));
}

TEST(MetricTally, AMissIsInfinitelyFarOff) {
  MetricTally tally;
  for (int i = 0; i < 10; ++i) tally.Add(Hit(i, {0, 0, 0.010 + 0.001 * i}));
  for (int i = 10; i < 20; ++i) tally.Add(Without(i, Outcome::kMissed));
  EXPECT_EQ(Of(tally, "p50_error_mm").of, 20);
  EXPECT_NEAR(Of(tally, "p50_error_mm").value, 19.0, 1e-9);
  EXPECT_EQ(Of(tally, "p50_error_mm").interval->upper, kInfiniteValue);
  EXPECT_EQ(Of(tally, "p95_error_mm").value, kInfiniteValue);
  EXPECT_EQ(Of(tally, "p95_depth_mm").value, kInfiniteValue);
  EXPECT_EQ(Of(tally, "bias_z_mm").of, 10);
  EXPECT_FALSE(Of(tally, "rmse_across_mm").interval.has_value());  // All are equal: 0.
}

TEST(MetricTally, HitsAreCountedAtSeveralSharesOfTheSide) {
  MetricTally tally;
  int trial = 0;
  // Errors of 4, 8 and 20 % of a side of 2 m, in depth but for the last; and 40 % in depth alone.
  for (const Eigen::Vector3d& error :
       {Eigen::Vector3d(0, 0, 0.08), Eigen::Vector3d(0, 0, 0.16), Eigen::Vector3d(0.4, 0, 0)}) {
    tally.Add(Hit(trial++, error));
  }
  tally.Add(Hit(trial++, {0, 0, 0.8}));
  tally.Add(Without(trial++, Outcome::kMissed));
  MetricTally of_two_metres;
  for (MetricRow row : tally.rows()) {
    row.side_m = 2.0;
    if (row.error_C && row.error_C->norm() > 0.5) row.outcome = Outcome::kGross;
    of_two_metres.Add(row);
  }
  const auto count = [&](const char* name) { return Of(of_two_metres, name).count; };
  EXPECT_EQ(count("hit_rate_5pct"), 1);
  EXPECT_EQ(count("hit_rate_10pct"), 2);
  EXPECT_EQ(count("hit_rate"), 3);
  EXPECT_EQ(count("depth_rate_5pct"), 2);
  EXPECT_EQ(count("depth_rate_10pct"), 3);
  EXPECT_EQ(count("depth_rate_25pct"), 3);
  EXPECT_EQ(count("across_rate_5pct"), 3);  // That which is gross in depth is right across.
  EXPECT_EQ(count("across_rate_25pct"), 4);
  EXPECT_EQ(Of(of_two_metres, "hit_rate_5pct").of, 5);
}

TEST(MetricTally, AWrongWindowIsNeverWithin) {
  MetricTally tally;
  MetricRow wrong = Hit(0, {0, 0, 0.01});
  wrong.outcome = Outcome::kWrongWindow;
  tally.Add(wrong);
  for (const char* name : {"hit_rate_5pct", "depth_rate_25pct", "across_rate_25pct"}) {
    EXPECT_EQ(Of(tally, name).count, 0) << name;
  }
}

TEST(MetricTally, OverTheBoundIsOfTheSameHits) {
  MetricTally tally;
  for (int i = 0; i < 8; ++i) {
    MetricRow row = Hit(i, {0.003, 0, 0.004 + 0.001 * i});
    row.bound_variances_C = Eigen::Vector3d(1e-6, 2e-6, (1 + i) * 1e-6);
    tally.Add(row);
  }
  const double mean_variance = 1e-6 * (1 + 2 + 4.5);
  EXPECT_NEAR(Of(tally, "rmse_over_bound").value,
              1e-3 * Of(tally, "rmse_mm").value / std::sqrt(mean_variance), 1e-12);
  EXPECT_NEAR(Of(tally, "rms_error_over_bound").of, 8, 0);
  EXPECT_LT(Of(tally, "rmse_over_bound").interval->lower, Of(tally, "rmse_over_bound").value);
  tally.Add(Hit(8, {0, 0, 0.001}));  // Without a bound.
  EXPECT_FALSE(tally.Estimate(*FindMetric("rmse_over_bound")).has_value());
  EXPECT_EQ(Of(tally, "rms_error_over_bound").of, 8);
}

TEST(MetricTally, RowsThatAreNotIndependentCountForTheValueAlone) {
  MetricTally tally;
  for (int i = 0; i < 40; ++i) {
    MetricRow row = i % 4 == 0 ? Without(i, Outcome::kMissed) : Hit(i, {0, 0, 0.001 * i});
    row.is_independent = i % 2 == 0;
    tally.Add(row);
  }
  const MetricEstimate rate = Of(tally, "hit_rate");
  EXPECT_EQ(rate.value, 0.75);
  EXPECT_EQ(rate.of, 40);
  EXPECT_EQ(rate.clusters, 20);
  EXPECT_EQ(rate.interval->lower, ClopperPearson(10, 20).lower);
  EXPECT_EQ(Of(tally, "bias_z_mm").clusters, 10);
}

TEST(MetricTally, WiderConfidenceIsWider) {
  MetricTally tally;
  for (int i = 0; i < 40; ++i) tally.Add(Hit(i, {0, 0.001 * (i % 7), 0.001 * i}));
  for (const char* name : {"hit_rate", "bias_z_mm", "rmse_mm", "trimmed_rmse_mm", "p50_error_mm"}) {
    const Interval narrow = *Of(tally, name, 0.90).interval;
    const Interval wide = *Of(tally, name, 0.99).interval;
    EXPECT_LT(wide.lower, narrow.lower) << name;
    EXPECT_GE(wide.upper, narrow.upper) << name;
  }
}

TEST(MetricTally, SaysNothingOfWhatThereIsNot) {
  EXPECT_TRUE(EstimatesOf(MetricTally()).empty());
  MetricTally unknown_side;
  MetricRow row = Hit(0, {0, 0, 0.001});
  row.side_m.reset();
  unknown_side.Add(row);
  EXPECT_FALSE(unknown_side.Estimate(*FindMetric("hit_rate_5pct")).has_value());
}

// 24 cells without a false alarm in any of 130 replicates that they share: bounded by what 130
// independent scenes bound.
TEST(MetricTally, SharedReplicatesAreNoIndependentWitnesses) {
  MetricTally tally;
  MetricTally forgetful;
  for (int cell = 0; cell < 24; ++cell) {
    for (int trial = 0; trial < 130; ++trial) {
      tally.Add(Empty(trial, Outcome::kClear));
      forgetful.Add(Empty(130 * cell + trial, Outcome::kClear));
    }
  }
  const MetricEstimate alarms = Of(tally, "false_alarm_rate", 0.90);
  EXPECT_EQ(alarms.of, 3120);
  EXPECT_EQ(alarms.clusters, 130);
  EXPECT_NEAR(alarms.interval->upper, 1.0 - std::pow(0.05, 1.0 / 130.0), 1e-12);  // 2.28 %.
  EXPECT_EQ(alarms.method, "Clopper-Pearson, clustered");
  EXPECT_NEAR(Of(forgetful, "false_alarm_rate", 0.90).interval->upper, 0.00096, 1e-5);
}

// A study of cells that share their replicates. Half of the variance of each component of the
// error, and of what decides whether it is a hit, is the replicate's.
constexpr int kReplicates = 40;
constexpr int kCells = 8;
constexpr double kSigma_m = 0.010;
constexpr double kHitRate = 0.9;
constexpr double kThreshold = -1.2815515655446004;  // P(x > it) = 0.9 for a standard normal x.

MetricTally SharedStudy(uint64_t run, bool know_clusters) {
  MetricTally tally;
  for (int r = 0; r < kReplicates; ++r) {
    const RandomStream own = RandomStream(run).Child("replicate", static_cast<uint64_t>(r));
    for (int c = 0; c < kCells; ++c) {
      const auto shared_half = [&](uint64_t i) {
        const uint64_t alone = 100 + 10 * static_cast<uint64_t>(c) + i;
        return std::sqrt(0.5) * (own.Normal(i) + own.Normal(alone));
      };
      const int trial = know_clusters ? r : kCells * r + c;
      if (shared_half(3) > kThreshold) {
        tally.Add(
            Hit(trial, kSigma_m * Eigen::Vector3d(shared_half(0), shared_half(1), shared_half(2))));
      } else {
        tally.Add(Without(trial, Outcome::kMissed));
      }
    }
  }
  return tally;
}

// Share of runs whose 95 % interval covers the truth.
double Coverage(const char* name, double truth, bool know_clusters, int runs) {
  int covered = 0;
  for (int run = 0; run < runs; ++run) {
    const MetricTally tally = SharedStudy(static_cast<uint64_t>(run), know_clusters);
    const Interval interval = Of(tally, name).interval.value();
    covered += interval.lower <= truth && truth <= interval.upper ? 1 : 0;
  }
  return static_cast<double>(covered) / runs;
}

struct Law95 {
  const char* name;
  double truth;
};

// Of a χ² with three degrees of freedom 0.5/0.9 are below 2.67528 (the misses are beyond); the mean
// of the 95 % that are below 7.8147 is 2.63133.
const Law95 kLaws[] = {{"hit_rate", kHitRate},
                       {"bias_z_mm", 0.0},
                       {"rmse_mm", 1e3 * std::sqrt(3.0) * kSigma_m},
                       {"trimmed_rmse_mm", 1e3 * std::sqrt(2.63133) * kSigma_m},
                       {"p50_error_mm", 1e3 * std::sqrt(2.67528) * kSigma_m}};

TEST(MetricTally, ClusteredIntervalsCoverAsOftenAsTheySay) {
  constexpr int kRuns = 1000;
  // Four standard deviations of a share of 95 % in 1000 runs, a false alarm of 3e-5, and 1 % for
  // what is approximate: these intervals are of first order, with 40 clusters.
  const double limit = 0.95 - 0.01 - 4.0 * std::sqrt(0.95 * 0.05 / kRuns);
  for (const Law95& law : kLaws) {
    EXPECT_GE(Coverage(law.name, law.truth, true, kRuns), limit) << law.name;
  }
}

TEST(MetricTally, ForgettingTheClustersIsFoundOut) {
  constexpr int kRuns = 300;
  const double limit = 0.95 - 0.01 - 4.0 * std::sqrt(0.95 * 0.05 / kRuns);
  for (const Law95& law : kLaws) {
    EXPECT_LT(Coverage(law.name, law.truth, false, kRuns), limit) << law.name;
  }
}

}  // namespace
}  // namespace fenestra
