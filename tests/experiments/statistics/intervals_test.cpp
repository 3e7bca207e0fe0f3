#include "experiments/statistics/intervals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/random/random_stream.h"
#include "experiments/statistics/clustered_intervals.h"
#include "experiments/statistics/moments.h"

namespace fenestra {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> Normals(uint64_t seed, size_t n, double mean) {
  const RandomStream stream(seed);
  std::vector<double> values;
  for (uint64_t i = 0; i < n; ++i) values.push_back(mean + stream.Normal(i));
  return values;
}

bool Covers(const Interval& interval, double value) {
  return interval.lower <= value && value <= interval.upper;
}

double BinomialProbability(int k, int n, double p) {
  return std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                  k * std::log(p) + (n - k) * std::log1p(-p));
}

// Of a continuous distribution the interval [x_(l), x_(u)] covers the quantile when the number of
// values below it is from l to u - 1.
double ExactCoverage(int n, double p, double confidence) {
  std::vector<double> ranks(static_cast<size_t>(n));
  std::iota(ranks.begin(), ranks.end(), 1.0);
  const Interval interval = QuantileInterval(ranks, p, confidence);
  double coverage = 0.0;
  for (int k = 0; k <= n; ++k) {
    if (interval.lower <= k && k < interval.upper) coverage += BinomialProbability(k, n, p);
  }
  return coverage;
}

TEST(QuantileInterval, CoversAtLeastWithTheNominalConfidence) {
  for (const double confidence : {0.80, 0.95, 0.99}) {
    for (const double p : {0.05, 0.5, 0.9, 0.95}) {
      for (const int n : {1, 5, 20, 59, 93, 200, 1000}) {
        const double coverage = ExactCoverage(n, p, confidence);
        EXPECT_GE(coverage, confidence - 1e-10) << n << " " << p;
        // Not wider than it must be: one rank less at both ends would not do. A rank has a
        // probability of at most 1/√(2π n p (1 - p)), by Stirling.
        if (n >= 200) {
          EXPECT_LE(coverage, confidence + 2.5 / std::sqrt(6.28 * n * p * (1.0 - p))) << n;
        }
      }
    }
  }
}

TEST(QuantileInterval, HasNoEndWhereTheSampleIsTooSmall) {
  // All 59 values below P95 have probability 0.95^59 = 4.8 %, more than the 2.5 % of a tail;
  // from 72 on 0.95^72 = 2.49 %.
  EXPECT_EQ(QuantileInterval(std::vector<double>(71, 1.0), 0.95).upper, kInfinity);
  EXPECT_EQ(QuantileInterval(std::vector<double>(72, 1.0), 0.95).upper, 1.0);
  EXPECT_EQ(QuantileInterval({}, 0.5).lower, -kInfinity);
}

// Misses are values at +∞ like any other: 4 % of them leave P95 finite, 6 % do not.
TEST(QuantileInterval, CoversWhereMissesAreInfinite) {
  for (const double misses : {0.04, 0.06, 0.5}) {
    int covered = 0;
    constexpr int kRuns = 1000;
    const double truth = misses < 0.05 ? std::sqrt(0.95 / (1.0 - misses)) : kInfinity;
    for (uint64_t run = 0; run < kRuns; ++run) {
      const RandomStream stream(run);
      std::vector<double> values;
      for (uint64_t i = 0; i < 150; ++i) {
        // Otherwise the root of a uniform number: P(X ≤ x) = x².
        values.push_back(stream.Child("miss").Uniform(i) < misses ? kInfinity
                                                                  : std::sqrt(stream.Uniform(i)));
      }
      covered += Covers(QuantileInterval(values, 0.95), truth) ? 1 : 0;
    }
    // 950 or more expected; standard deviation at most 6.9; four below: 3e-5.
    EXPECT_GE(covered, 950 - 28) << misses;
  }
}

TEST(MeanInterval, CoversNormalValuesExactlyAndOthersNearly) {
  constexpr int kRuns = 4000;
  int normal = 0;
  int uniform = 0;
  for (uint64_t run = 0; run < kRuns; ++run) {
    normal += Covers(*MeanInterval(Normals(run, 5, 3.0)), 3.0) ? 1 : 0;
    std::vector<double> values;
    for (uint64_t i = 0; i < 30; ++i) values.push_back(RandomStream(run).Uniform(i));
    uniform += Covers(*MeanInterval(values), 0.5) ? 1 : 0;
  }
  // 3800 expected, standard deviation 13.8; four: 6e-5.
  EXPECT_NEAR(normal, 3800, 55);
  EXPECT_NEAR(uniform, 3800, 55);
}

TEST(RootMeanSquareInterval, CoversAsOftenAsItSays) {
  constexpr int kRuns = 1500;
  for (const size_t n : {10u, 30u}) {
    for (const double mean : {0.0, 1.0}) {
      int covered = 0;
      for (uint64_t run = 0; run < kRuns; ++run) {
        const auto interval =
            RootMeanSquareInterval(Normals(run, n, mean), RandomStream(run).Child("resampling"));
        covered += Covers(*interval, std::sqrt(1.0 + mean * mean)) ? 1 : 0;
      }
      // Promised: from 93 to 97 %; four standard deviations (9.9 and 6.6) beyond: 3e-5 each.
      EXPECT_GE(covered, 1395 - 40) << n << " " << mean;
      EXPECT_LE(covered, 1455 + 27) << n << " " << mean;
    }
  }
}

// The twin: percentiles of the plain bootstrap, which leave out how the spread goes with the size.
TEST(RootMeanSquareInterval, TheCoverageRejectsAPlainNormalInterval) {
  int covered = 0;
  for (uint64_t run = 0; run < 1500; ++run) {
    std::vector<double> squares;
    for (const double x : Normals(run, 10, 0.0)) squares.push_back(x * x);
    const double half = 1.96 * StandardErrorOfMean(squares);
    covered += std::abs(Mean(squares) - 1.0) <= half ? 1 : 0;
  }
  EXPECT_LT(covered, 1355);
}

TEST(RootMeanSquareInterval, IsSilentWhereThereIsNoSpreadToJudgeBy) {
  EXPECT_FALSE(RootMeanSquareInterval(std::vector<double>(20, 0.5), RandomStream(1)));
  EXPECT_FALSE(RootMeanSquareInterval(std::vector<double>{1, 2, 3, 4}, RandomStream(1)));
  EXPECT_FALSE(MeanInterval(std::vector<double>{1.0}));
}

TEST(Looks, GrowByHalfUpToTheMost) {
  EXPECT_EQ(Looks(20, 100), (std::vector<int>{20, 30, 45, 67, 100}));
  EXPECT_EQ(Looks(1, 5), (std::vector<int>{1, 2, 3, 4, 5}));
  EXPECT_EQ(Looks(20, 20), std::vector<int>{20});
  EXPECT_EQ(Looks(20, 7), std::vector<int>{7});
  EXPECT_EQ(Looks(20, 30), (std::vector<int>{20, 30}));
  EXPECT_EQ(Looks(1'000'000, 2'000'000'000).back(), 2'000'000'000);
}

// Someone who stops as soon as the interval misses the true rate, the worst rule there is. Returns
// how many of the runs end with a wrong interval.
int WrongRuns(int runs, double rate, const std::vector<int>& looks, double confidence) {
  int wrong = 0;
  for (int run = 0; run < runs; ++run) {
    const RandomStream stream(static_cast<uint64_t>(run));
    int successes = 0;
    int trials = 0;
    for (const int look : looks) {
      for (; trials < look; ++trials) {
        successes += stream.Uniform(static_cast<uint64_t>(trials)) < rate ? 1 : 0;
      }
      const Interval interval = ClopperPearson(successes, trials, confidence);
      if (interval.lower <= rate && rate <= interval.upper) continue;
      ++wrong;
      break;
    }
  }
  return wrong;
}

TEST(Looks, TheWorstRuleToStopIsWrongNoMoreOftenThanItSays) {
  constexpr int kRuns = 2000;
  const std::vector<int> looks = Looks(20, 2000);
  const double corrected = LookConfidence(0.90, static_cast<int>(looks.size()));
  for (const double rate : {0.5, 0.9}) {
    // 10 % of 2000 are 200; the standard deviation of the count is 13.4; 4 above: 3e-5.
    EXPECT_LE(WrongRuns(kRuns, rate, looks, corrected), 254) << rate;
    // The twin: without the correction it is wrong far more often.
    EXPECT_GE(WrongRuns(kRuns, rate, looks, 0.90), 400) << rate;
  }
}

}  // namespace
}  // namespace fenestra
