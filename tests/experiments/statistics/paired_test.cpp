#include "experiments/statistics/paired.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

constexpr double kInfiniteError = std::numeric_limits<double>::infinity();

double LogFactorial(int n) {
  return std::lgamma(n + 1.0);
}

// Runs `use(counts, probability)` over all that n pairs may give, as far as it matters.
template <typename Use>
void ForEachOutcome(int n, double only_first, double only_second, Use use) {
  const double same = 1.0 - only_first - only_second;
  for (int b = 0; b <= n; ++b) {
    for (int c = 0; b + c <= n; ++c) {
      const double log = LogFactorial(n) - LogFactorial(b) - LogFactorial(c) -
                         LogFactorial(n - b - c) + b * std::log(only_first) +
                         c * std::log(only_second) + (n - b - c) * std::log(same);
      if (log > -25.0) {
        use(PairedCounts{.both = n - b - c, .only_first = b, .only_second = c, .neither = 0},
            std::exp(log));
      }
    }
  }
}

TEST(ExactMcNemar, RejectsEqualDetectorsNoMoreOftenThanItSays) {
  for (const double discordant : {0.1, 0.4, 0.8}) {
    for (const double alpha : {0.05, 0.01}) {
      double rejected = 0.0;
      ForEachOutcome(60, discordant / 2, discordant / 2, [&](const PairedCounts& counts, double p) {
        if (ExactMcNemar(counts.only_first, counts.only_second) <= alpha) rejected += p;
      });
      EXPECT_LE(rejected, alpha + 1e-9);
    }
  }
}

TEST(ExactMcNemar, HasItsClosedForms) {
  EXPECT_EQ(ExactMcNemar(0, 0), 1.0);
  EXPECT_EQ(ExactMcNemar(4, 4), 1.0);
  EXPECT_NEAR(ExactMcNemar(0, 6), 2.0 / 64.0, 1e-15);
  EXPECT_NEAR(ExactMcNemar(7, 1), 2.0 * 9.0 / 256.0, 1e-15);
}

TEST(PairedDifference, CoversWithNoLessThanItPromises) {
  for (const int n : {30, 100}) {
    double worst = 1.0;
    for (const auto& [first, second] : std::vector<std::pair<double, double>>{
             {0.02, 0.02}, {0.1, 0.02}, {0.3, 0.05}, {0.3, 0.3}, {0.6, 0.1}, {0.1, 0.1}}) {
      double covered = 0.0;
      ForEachOutcome(n, first, second, [&](const PairedCounts& counts, double p) {
        const Interval interval = PairedDifferenceInterval(counts);
        const double truth = first - second;
        if (interval.lower <= truth && truth <= interval.upper) covered += p;
      });
      worst = std::min(worst, covered);
    }
    EXPECT_GE(worst, 0.935) << n;
  }
}

TEST(PairedDifference, IsThePublishedOne) {
  // Tango's example: 44 lens pairs, one of which only one solution disinfects.
  const Interval interval =
      PairedDifferenceInterval({.both = 43, .only_first = 0, .only_second = 1, .neither = 0});
  EXPECT_NEAR(interval.lower, -0.118, 5e-4);
  EXPECT_NEAR(interval.upper, 0.059, 5e-4);
}

TEST(PairedDifference, ChangesSignWithTheOrder) {
  const Interval one = PairedDifferenceInterval({20, 7, 2, 5});
  const Interval other = PairedDifferenceInterval({20, 2, 7, 5});
  EXPECT_NEAR(one.lower, -other.upper, 1e-12);
  EXPECT_NEAR(one.upper, -other.lower, 1e-12);
  EXPECT_GT(one.upper, PairedCounts({20, 7, 2, 5}).difference());
}

TEST(CompareErrors, CountsMissesAsInfinite) {
  const std::vector<double> first{1.0, 2.0, kInfiniteError, kInfiniteError, 5.0};
  const std::vector<double> second{2.0, 4.0, 3.0, kInfiniteError, kInfiniteError};
  const ErrorComparison comparison = CompareErrors({first, second});
  EXPECT_EQ(comparison.pairs, 5);
  EXPECT_EQ(comparison.first_nearer, 3);
  EXPECT_EQ(comparison.second_nearer, 1);
  EXPECT_EQ(comparison.both_finite, 2);
  EXPECT_EQ(comparison.mean_difference, -1.5);
  EXPECT_NEAR(comparison.sign_test_p, 2.0 * 5.0 / 16.0, 1e-15);
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
