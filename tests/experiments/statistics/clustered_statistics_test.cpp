#include "experiments/statistics/clustered_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random/random_stream.h"
#include "experiments/statistics/moments.h"
#include "experiments/statistics/paired.h"

namespace fenestra {
namespace {

TEST(ClusteredProportion, ClustersOfOneRowGiveClopperPearson) {
  std::vector<ClusterCount> clusters(40, {1, 1});
  for (size_t i = 0; i < 7; ++i) clusters[i].successes = 0;
  const EffectiveCount count = Effective(clusters);
  EXPECT_EQ(count.trials, 40.0);
  EXPECT_EQ(count.successes, 33.0);
  const Interval exact = ClopperPearson(33, 40, 0.90);  // Two-sided: 5 % on either side.
  EXPECT_NEAR(LowerProportionLimit(count, 0.95), exact.lower, 1e-12);
  EXPECT_NEAR(UpperProportionLimit(count, 0.95), exact.upper, 1e-12);
}

TEST(ClusteredProportion, RowsThatRepeatEachOtherCountOnce) {
  std::vector<ClusterCount> once;
  std::vector<ClusterCount> five_times;
  for (int i = 0; i < 60; ++i) {
    const int success = i % 4 == 0 ? 0 : 1;
    once.push_back({success, 1});
    five_times.push_back({5 * success, 5});
  }
  // Only r/(r-1) and the quantiles of t tell them apart, by some per cent.
  EXPECT_NEAR(Effective(five_times).trials, Effective(once).trials, 0.05 * 60);
  // All alike says nothing of how clusters scatter: as many rows as clusters.
  EXPECT_EQ(Effective(std::vector<ClusterCount>(30, {4, 4})).trials, 30.0);
}

// 24 rows of each of 130 replicates without one success: bounded by 1 - 0.05^(1/130).
TEST(ClusteredProportion, NoSuccessIsBoundedByTheNumberOfClusters) {
  std::vector<ClusterCount> clusters(130, {0, 24});
  EXPECT_NEAR(UpperProportionLimit(Effective(clusters), 0.95), 0.02278, 1e-5);
  // 3,120 independent rows would bound it by 0.1 %.
  EXPECT_NEAR(UpperProportionLimit({0.0, 3120.0}, 0.95), 0.00096, 1e-5);
  // More alarms never bound it more closely, and fewer never less so from below.
  double upper = 0.0;
  for (ClusterCount& cluster : clusters) {
    const double next = UpperProportionLimit(Effective(clusters), 0.95);
    EXPECT_GE(next, upper - 1e-12);
    upper = next;
    cluster.successes = 1;
  }
  for (ClusterCount& cluster : clusters) cluster.successes = cluster.trials;
  EXPECT_NEAR(LowerProportionLimit(Effective(clusters), 0.95), 1.0 - 0.02278, 1e-5);
  clusters.front().successes = 23;
  EXPECT_LE(LowerProportionLimit(Effective(clusters), 0.95), 1.0 - 0.02277);
}

/// How often, of `kClusteredStudies` simulated studies, a limit at confidence 0.95 is on the wrong
/// side of p. Half of the variance of a row's success is its replicate's.
constexpr int kClusteredStudies = 2000;

double WrongSideRate(int replicates, int cells, bool know_clusters) {
  constexpr double kThreshold = -1.2815515655446004;  // P(x > it) = 0.9 for a standard normal x.
  int wrong = 0;
  for (int run = 0; run < kClusteredStudies; ++run) {
    const RandomStream stream = RandomStream(5).Child("run", static_cast<uint64_t>(run));
    std::vector<ClusterCount> clusters;
    for (int r = 0; r < replicates; ++r) {
      const RandomStream own = stream.Child("replicate", static_cast<uint64_t>(r));
      ClusterCount count;
      for (int c = 0; c < cells; ++c) {
        const double x =
            std::sqrt(0.5) * (own.Normal(0) + own.Normal(static_cast<uint64_t>(c) + 1));
        const int success = x > kThreshold ? 1 : 0;
        if (know_clusters) {
          count.successes += success;
          ++count.trials;
        } else {
          clusters.push_back({success, 1});
        }
      }
      if (know_clusters) clusters.push_back(count);
    }
    wrong += LowerProportionLimit(Effective(clusters), 0.95) > 0.9 ? 1 : 0;
  }
  return static_cast<double>(wrong) / kClusteredStudies;
}

// 4 sigma of a share of 5 % in 2000 runs: a false alarm of 3e-5.
const double kFourSigma = 4.0 * std::sqrt(0.05 * 0.95 / kClusteredStudies);

TEST(ClusteredProportion, LimitsAreOnTheWrongSideNoMoreOftenThanStated) {
  EXPECT_LE(WrongSideRate(40, 1, true), 0.05 + kFourSigma);
  EXPECT_LE(WrongSideRate(40, 8, true), 0.05 + kFourSigma);
}

TEST(ClusteredProportion, ForgettingTheClustersIsFoundOut) {
  EXPECT_GT(WrongSideRate(40, 8, false), 0.05 + kFourSigma);
}

double MeanWrongSideRate(int replicates, int cells, bool know_clusters) {
  int wrong = 0;
  for (int run = 0; run < kClusteredStudies; ++run) {
    const RandomStream stream = RandomStream(6).Child("run", static_cast<uint64_t>(run));
    std::vector<ClusterSum> clusters;
    for (int r = 0; r < replicates; ++r) {
      const RandomStream own = stream.Child("replicate", static_cast<uint64_t>(r));
      ClusterSum sum;
      for (int c = 0; c < cells; ++c) {
        const double x = own.Normal(0) + own.Normal(static_cast<uint64_t>(c) + 1);
        if (!know_clusters) clusters.push_back({x, 1});
        sum.sum += x;
        ++sum.weight;
      }
      if (know_clusters) clusters.push_back(sum);
    }
    wrong += MeanOf(clusters).Quantile(0.05) > 0.0 ? 1 : 0;
  }
  return static_cast<double>(wrong) / kClusteredStudies;
}

TEST(ClusteredMean, LimitsAreOnTheWrongSideAsOftenAsStated) {
  EXPECT_NEAR(MeanWrongSideRate(15, 1, true), 0.05, kFourSigma);
  EXPECT_NEAR(MeanWrongSideRate(15, 6, true), 0.05, kFourSigma);
  EXPECT_GT(MeanWrongSideRate(15, 6, false), 0.05 + kFourSigma);
}

TEST(ClusteredMean, OneClusterLimitsNothing) {
  const ClusteredMean mean = MeanOf(std::vector<ClusterSum>{{6.0, 3}});
  EXPECT_EQ(mean.mean, 2.0);
  EXPECT_EQ(mean.Quantile(0.95), std::numeric_limits<double>::infinity());
  EXPECT_EQ(mean.Quantile(0.05), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace fenestra
