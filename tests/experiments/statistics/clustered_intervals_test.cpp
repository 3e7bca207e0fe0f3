#include "experiments/statistics/clustered_intervals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

constexpr double kInfiniteBound = std::numeric_limits<double>::infinity();

TEST(ClusteredQuantileInterval, ClustersOfOneRowGiveOrderStatistics) {
  for (const size_t n : {1, 5, 72, 200}) {
    std::vector<ClusteredValue> rows;
    std::vector<double> values;
    for (size_t i = 0; i < n; ++i) {
      values.push_back(RandomStream(n).Normal(i));
      rows.push_back({values.back(), i});
    }
    for (const double p : {0.05, 0.5, 0.95}) {
      const Interval expected = QuantileInterval(values, p);
      const Interval interval = ClusteredQuantileInterval(rows, p);
      EXPECT_EQ(interval.lower, expected.lower) << n << " " << p;
      EXPECT_EQ(interval.upper, expected.upper) << n << " " << p;
    }
  }
}

// Inverting limits of shares is what order statistics do, too: one pair of equal rows changes
// little.
TEST(ClusteredQuantileInterval, IsNearlyThatOfOrderStatisticsWithHardlyAnyClusters) {
  std::vector<ClusteredValue> rows;
  std::vector<double> values;
  for (size_t i = 0; i < 300; ++i) {
    values.push_back(static_cast<double>(i));
    rows.push_back({values.back(), i == 1 ? 0 : i});
  }
  // Cluster 1 has no row.
  const Interval interval = ClusteredQuantileInterval(rows, 0.5);
  EXPECT_NEAR(interval.lower, QuantileInterval(values, 0.5).lower, 2.0);
  EXPECT_NEAR(interval.upper, QuantileInterval(values, 0.5).upper, 2.0);
}

TEST(ClusteredQuantileInterval, HasNoEndWhereClustersAreTooFew) {
  // 72 clusters of ten equal rows: as many witnesses as 72 rows, which just bound P95 from above.
  const auto equal_rows = [](size_t clusters) {
    std::vector<ClusteredValue> rows;
    for (size_t i = 0; i < 10 * clusters; ++i) rows.push_back({1.0, i / 10});
    return rows;
  };
  EXPECT_EQ(ClusteredQuantileInterval(equal_rows(71), 0.95).upper, kInfiniteBound);
  EXPECT_EQ(ClusteredQuantileInterval(equal_rows(72), 0.95).upper, 1.0);
  EXPECT_EQ(ClusteredQuantileInterval({}, 0.5).lower, -kInfiniteBound);
}

TEST(ClusteredQuantileInterval, MissesAreInfinite) {
  std::vector<ClusteredValue> rows;
  for (size_t i = 0; i < 400; ++i) rows.push_back({i % 10 == 0 ? kInfiniteBound : 1.0, i / 4});
  EXPECT_EQ(ClusteredQuantileInterval(rows, 0.5).upper, 1.0);
  EXPECT_EQ(ClusteredQuantileInterval(rows, 0.98).lower, kInfiniteBound);
}

TEST(ClusteredRmsInterval, ClustersOfOneRowGiveTheIntervalOfTheRms) {
  std::vector<double> values;
  std::vector<ClusterSum> clusters;
  for (uint64_t i = 0; i < 50; ++i) {
    values.push_back(RandomStream(3).Normal(i));
    clusters.push_back({values.back() * values.back(), 1.0});
  }
  const auto expected = RootMeanSquareInterval(values, RandomStream(4));
  const auto interval = ClusteredRmsInterval(clusters, RandomStream(4));
  EXPECT_EQ(interval->lower, expected->lower);
  EXPECT_EQ(interval->upper, expected->upper);
  // A ratio has the unit of its weights.
  for (ClusterSum& cluster : clusters) cluster.weight = 4.0;
  EXPECT_NEAR(ClusteredRmsInterval(clusters, RandomStream(4))->lower, 0.5 * expected->lower, 1e-12);
  clusters.resize(kFewestForRms - 1);
  EXPECT_FALSE(ClusteredRmsInterval(clusters, RandomStream(4)).has_value());
}

}  // namespace
}  // namespace fenestra
