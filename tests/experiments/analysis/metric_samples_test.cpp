#include "experiments/analysis/metric_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace fenestra {
namespace {

// A hit of replicate `trial` in a cell of its own, one metre's window.
MetricRow SampledHit(int trial, const Eigen::Vector3d& error_C) {
  return {.outcome = Outcome::kHit,
          .has_target = true,
          .cluster = {.replicate = trial},
          .error_C = error_C,
          .side_m = 1.0};
}

MetricRow SampledOutcome(int trial, Outcome outcome, bool has_target) {
  return {.outcome = outcome, .has_target = has_target, .cluster = {.replicate = trial}};
}

std::vector<Sample> Squares(const std::vector<double>& values) {
  std::vector<Sample> samples;
  for (size_t i = 0; i < values.size(); ++i) {
    samples.push_back({.value = values[i], .cluster = {.replicate = static_cast<int>(i)}});
  }
  return samples;
}

TEST(MetricSamples, ARowWithoutAnEstimateIsAnInfiniteErrorOfAQuantileAndNoneOfAnRmse) {
  const std::vector<MetricRow> rows = {
      SampledHit(0, {0.003, 0, 0.004}), SampledOutcome(1, Outcome::kMissed, true),
      SampledOutcome(2, Outcome::kOutOfView, true), SampledOutcome(3, Outcome::kClear, false)};
  const auto quantile = SamplesOf(rows, FindMetric("p95_error_mm").value());
  ASSERT_EQ(quantile.size(), 2u);
  EXPECT_DOUBLE_EQ(quantile[0].value, 0.005);
  EXPECT_EQ(quantile[1].value, std::numeric_limits<double>::infinity());
  EXPECT_EQ(SamplesOf(rows, FindMetric("rmse_mm").value()).size(), 1u);
  EXPECT_EQ(SamplesOf(rows, FindMetric("false_alarm_rate").value()).size(), 1u);
  EXPECT_EQ(SamplesOf(rows, FindMetric("out_of_view_rate").value()).size(), 3u);
}

TEST(MetricSamples, ValuesAreSignedWhereTheirQuantityIs) {
  const MetricRow row = SampledHit(0, {-0.003, 0.004, -0.012});
  EXPECT_DOUBLE_EQ(SiValueOf(row, Quantity::kErrorX).value(), -0.003);
  EXPECT_DOUBLE_EQ(SiValueOf(row, Quantity::kErrorZ).value(), -0.012);
  EXPECT_DOUBLE_EQ(SiValueOf(row, Quantity::kErrorAcross).value(), 0.005);
  EXPECT_DOUBLE_EQ(SiValueOf(row, Quantity::kError).value(), 0.013);
  EXPECT_FALSE(SiValueOf(row, Quantity::kTime));
}

TEST(MetricSamples, RowsOfOneReplicateAreOneCluster) {
  std::vector<MetricRow> rows;
  for (int trial : {4, 7, 4, 9, 7}) rows.push_back(SampledHit(trial, {0.001 * trial, 0, 0}));
  const auto samples = SamplesOf(rows, FindMetric("rmse_mm").value());
  const ClusteredSamples clustered(samples);
  EXPECT_EQ(clustered.clusters(), 3u);
  EXPECT_FALSE(clustered.AreIndependent());
  const std::vector<size_t> expected = {0, 1, 0, 2, 1};
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(clustered.ClusterOf(i), expected[i]) << i;
  const std::vector<ClusterSum> sums = clustered.SquareSums();
  ASSERT_EQ(sums.size(), 3u);
  EXPECT_DOUBLE_EQ(sums[0].sum, 2.0 * 16e-6);
  EXPECT_DOUBLE_EQ(sums[0].weight, 2.0);
  EXPECT_DOUBLE_EQ(sums[2].sum, 81e-6);
}

TEST(MetricSamples, ClustersThatAgreeCountAsOneRowEach) {
  // 40 replicates in 24 cells that all share their luck: as many successes as replicates tell.
  std::vector<MetricRow> rows;
  for (int trial = 0; trial < 40; ++trial) {
    for (int cell = 0; cell < 24; ++cell) {
      rows.push_back(trial < 10 ? SampledHit(trial, {0, 0, 0})
                                : SampledOutcome(trial, Outcome::kMissed, true));
    }
  }
  const auto samples = SamplesOf(rows, FindMetric("hit_rate").value());
  ASSERT_EQ(samples.size(), 960u);
  const EffectiveCount effective = ClusteredSamples(samples).Effective();
  EXPECT_LE(effective.trials, 40.0);
  EXPECT_NEAR(effective.successes / effective.trials, 0.25, 1e-12);
}

TEST(MetricSamples, TrimmingLeavesOutTheLargestTwentiethRoundedDown) {
  std::vector<double> values(39, 1.0);
  values.push_back(-100.0);
  const TrimmedSquares trimmed = Trim(Squares(values));  // 5 % of 40 are two.
  EXPECT_EQ(trimmed.left, 38u);
  EXPECT_DOUBLE_EQ(trimmed.mean, 1.0);
  EXPECT_DOUBLE_EQ(trimmed.largest, 1.0);
  const TrimmedSquares whole = Trim(Squares({1.0, 2.0, 3.0}));
  EXPECT_EQ(whole.left, 3u);
  EXPECT_DOUBLE_EQ(whole.mean, 14.0 / 3.0);
}

// Tukey and McLaughlin 1963: s_w / ((1 - γ) √n), with s_w² the variance of the values of which the
// largest share γ is replaced by the largest that is left.
TEST(MetricSamples, ATrimmedMeansStandardErrorIsThatOfTheWinsorisedValues) {
  std::vector<double> values;
  for (int i = 1; i <= 40; ++i) values.push_back(std::sqrt(i));
  std::vector<double> winsorised;
  for (int i = 1; i <= 40; ++i) winsorised.push_back(std::min(i, 38));
  const double standard_error = StandardDeviation(winsorised) / (0.95 * std::sqrt(40.0));
  const double mean = 0.5 * (1 + 38);
  const std::vector<Sample> samples = Squares(values);
  EXPECT_NEAR(ClusteredSamples(samples).TrimmedLogarithm().standard_error, standard_error / mean,
              1e-12);
}

TEST(MetricSamples, BoundsAreAbsentUnlessAllHitsHaveOne) {
  std::vector<MetricRow> rows = {SampledHit(0, {0, 0, 0}), SampledHit(1, {0, 0, 0})};
  EXPECT_FALSE(BoundsOfHits(rows));
  for (MetricRow& row : rows) row.bound_variances_C = Eigen::Vector3d(1e-6, 3e-6, 5e-6);
  const ErrorBounds bounds = BoundsOfHits(rows).value();
  EXPECT_DOUBLE_EQ(bounds.all, std::sqrt(9e-6));
  EXPECT_DOUBLE_EQ(bounds.depth, std::sqrt(5e-6));
  EXPECT_DOUBLE_EQ(bounds.across, std::sqrt(4e-6));
  rows[1].bound_variances_C.reset();
  EXPECT_FALSE(BoundsOfHits(rows));
}

}  // namespace
}  // namespace fenestra
