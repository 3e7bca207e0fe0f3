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

/// How often, of `kRuns` simulated studies, a limit at confidence 0.95 is on the wrong side of p.
/// Half of the variance of a row's success is its replicate's.
constexpr int kRuns = 2000;

double WrongSideRate(int replicates, int cells, bool know_clusters) {
  constexpr double kThreshold = -1.2815515655446004;  // P(x > it) = 0.9 for a standard normal x.
  int wrong = 0;
  for (int run = 0; run < kRuns; ++run) {
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
  return static_cast<double>(wrong) / kRuns;
}

// 4 sigma of a share of 5 % in 2000 runs: a false alarm of 3e-5.
const double kFourSigma = 4.0 * std::sqrt(0.05 * 0.95 / kRuns);

TEST(ClusteredProportion, LimitsAreOnTheWrongSideNoMoreOftenThanStated) {
  EXPECT_LE(WrongSideRate(40, 1, true), 0.05 + kFourSigma);
  EXPECT_LE(WrongSideRate(40, 8, true), 0.05 + kFourSigma);
}

TEST(ClusteredProportion, ForgettingTheClustersIsFoundOut) {
  EXPECT_GT(WrongSideRate(40, 8, false), 0.05 + kFourSigma);
}

double MeanWrongSideRate(int replicates, int cells, bool know_clusters) {
  int wrong = 0;
  for (int run = 0; run < kRuns; ++run) {
    const RandomStream stream = RandomStream(6).Child("run", static_cast<uint64_t>(run));
    std::vector<ClusterSum> clusters;
    for (int r = 0; r < replicates; ++r) {
      const RandomStream own = stream.Child("replicate", static_cast<uint64_t>(r));
      ClusterSum sum;
      for (int c = 0; c < cells; ++c) {
        const double x = own.Normal(0) + own.Normal(static_cast<uint64_t>(c) + 1);
        if (!know_clusters) clusters.push_back({x, 1});
        sum.sum += x;
        ++sum.rows;
      }
      if (know_clusters) clusters.push_back(sum);
    }
    wrong += MeanOf(clusters).Quantile(0.05) > 0.0 ? 1 : 0;
  }
  return static_cast<double>(wrong) / kRuns;
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

TEST(SignFlip, IsMcNemarsTestOfDiscordantPairs) {
  // 8 of 10 pairs speak for it: P(X ≥ 8) of a fair coin, (45 + 10 + 1)/1024.
  std::vector<double> d(10, 1.0);
  d[0] = d[1] = -1.0;
  d.resize(50, 0.0);
  EXPECT_DOUBLE_EQ(SignFlipPValue(d), 56.0 / 1024.0);
}

TEST(SignFlip, IsWilcoxonsTestOfRanks) {
  // Ranks 1 to 5, only the least one negative: 3 of the 32 assignments reach 13.
  EXPECT_DOUBLE_EQ(SignFlipPValue(std::vector<double>{-1.0, 2.0, 3.0, 4.0, 5.0}), 2.0 / 32.0);
  EXPECT_EQ(SignFlipPValue(std::vector<double>{}), 1.0);
  EXPECT_EQ(SignFlipPValue(std::vector<double>(9, 0.0)), 1.0);
}

TEST(SignFlip, KeepsItsLevel) {
  // Enumerated, resampled and normal: differences that are symmetric but far from normal.
  for (const int n : {10, 40}) {
    int rejected = 0;
    constexpr int kTests = 400;
    for (uint64_t t = 0; t < kTests; ++t) {
      std::vector<double> d;
      for (uint64_t i = 0; i < static_cast<uint64_t>(n); ++i) {
        const double x = RandomStream(9).Child("test", t).Normal(i);
        d.push_back(x * x * x);
      }
      rejected += SignFlipPValue(d) <= 0.05 ? 1 : 0;
    }
    EXPECT_LE(rejected, 400 * 0.05 + 4.0 * std::sqrt(400 * 0.05 * 0.95)) << n;
  }
  std::vector<double> many(3000, 1.0);
  for (size_t i = 0; i < 1450; ++i) many[i] = -1.0;
  // Σ d / √Σ d² = 100/√3000 = 1.826: an upper tail of 0.0339.
  EXPECT_NEAR(SignFlipPValue(many), 0.0339, 1e-4);
}

}  // namespace
}  // namespace fenestra
