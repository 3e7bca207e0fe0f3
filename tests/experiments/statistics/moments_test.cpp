#include "experiments/statistics/moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

constexpr double kInfiniteValue = std::numeric_limits<double>::infinity();

/// P(X = k) for X ~ Binomial(n, p), 0 < p < 1.
double ProbabilityOfHits(int k, int n, double p) {
  const double log_choose = std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
  return std::exp(log_choose + k * std::log(p) + (n - k) * std::log1p(-p));
}

/// The probability that the interval made by `interval_of(k)` covers p, by enumeration.
double Coverage(int n, double p, const auto& interval_of) {
  double covered = 0.0;
  for (int k = 0; k <= n; ++k) {
    const Interval interval = interval_of(k);
    if (interval.lower <= p && p <= interval.upper) covered += ProbabilityOfHits(k, n, p);
  }
  return covered;
}

/// The smallest coverage over p = 0.002, 0.004, ..., 0.998.
double WorstCoverage(int n, const auto& interval_of) {
  double worst = 1.0;
  for (int i = 1; i < 500; ++i) worst = std::min(worst, Coverage(n, i / 500.0, interval_of));
  return worst;
}

// The enumeration sums at most 61 terms of relative error 1e-13 (lgamma of numbers up to 61).
constexpr double kEnumerationError = 1e-11;

TEST(ClopperPearson, CoversAtLeastWithTheNominalConfidence) {
  for (const double confidence : {0.80, 0.95, 0.99}) {
    for (const int n : {1, 2, 5, 20, 60}) {
      std::vector<Interval> intervals;
      for (int k = 0; k <= n; ++k) intervals.push_back(ClopperPearson(k, n, confidence));
      const auto interval_of = [&](int k) { return intervals[static_cast<size_t>(k)]; };
      EXPECT_GE(WorstCoverage(n, interval_of), confidence - kEnumerationError)
          << "n = " << n << ", confidence " << confidence;
    }
  }
}

TEST(ClopperPearson, TheEnumerationRejectsWaldsInterval) {
  const int n = 20;
  const auto wald = [](int k) {
    const double p = k / 20.0;
    const double half_width = 1.96 * std::sqrt(p * (1.0 - p) / 20.0);
    return Interval{.lower = p - half_width, .upper = p + half_width};
  };
  EXPECT_LT(WorstCoverage(n, wald), 0.5);
}

TEST(ClopperPearson, HasItsClosedFormsAtTheEnds) {
  // k = 0: (1 - upper)^n = α/2; k = n: lower^n = α/2. Boost's quantiles are good to 1e-12.
  for (const int n : {1, 3, 20, 1000}) {
    const double tail = std::pow(0.025, 1.0 / n);
    const Interval none = ClopperPearson(0, n);
    EXPECT_EQ(none.lower, 0.0);
    EXPECT_NEAR(none.upper, 1.0 - tail, 1e-12);
    const Interval all = ClopperPearson(n, n);
    EXPECT_NEAR(all.lower, tail, 1e-12);
    EXPECT_EQ(all.upper, 1.0);
  }
  EXPECT_EQ(ClopperPearson(0, 0).lower, 0.0);
  EXPECT_EQ(ClopperPearson(0, 0).upper, 1.0);
}

TEST(ClopperPearson, SolvesItsDefinition) {
  // At the lower end P(X ≥ k) = α/2, at the upper one P(X ≤ k) = α/2.
  const int n = 20;
  const int k = 17;
  const Interval interval = ClopperPearson(k, n);
  double at_least = 0.0;
  for (int i = k; i <= n; ++i) at_least += ProbabilityOfHits(i, n, interval.lower);
  double at_most = 0.0;
  for (int i = 0; i <= k; ++i) at_most += ProbabilityOfHits(i, n, interval.upper);
  EXPECT_NEAR(at_least, 0.025, kEnumerationError);
  EXPECT_NEAR(at_most, 0.025, kEnumerationError);
}

TEST(ClopperPearson, IsSymmetricInSuccessAndFailure) {
  for (int k = 0; k <= 30; ++k) {
    const Interval a = ClopperPearson(k, 30);
    const Interval b = ClopperPearson(30 - k, 30);
    EXPECT_NEAR(a.lower, 1.0 - b.upper, 1e-12);
    EXPECT_NEAR(a.upper, 1.0 - b.lower, 1e-12);
  }
}

TEST(SampleQuantile, IsTheSmallestValueThatReachesTheShare) {
  const std::vector<double> values = {4.0, 1.0, 3.0, 2.0};
  EXPECT_EQ(SampleQuantile(values, 1e-9), 1.0);
  EXPECT_EQ(SampleQuantile(values, 0.25), 1.0);
  EXPECT_EQ(SampleQuantile(values, std::nextafter(0.25, 1.0)), 2.0);
  EXPECT_EQ(SampleQuantile(values, 0.5), 2.0);
  EXPECT_EQ(SampleQuantile(values, 0.51), 3.0);
  EXPECT_EQ(SampleQuantile(values, 1.0), 4.0);
}

TEST(SampleQuantile, EveryHundredthOfAHundredIsThatRank) {
  // 100 · 0.07 and others round up to above a whole number; the rank must not.
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  for (int i = 1; i <= 100; ++i) EXPECT_EQ(SampleQuantile(values, i / 100.0), i);
}

TEST(SampleQuantile, MoreThanTheTailOfMissesMakesItInfinite) {
  std::vector<double> values(20, 0.1);
  values[3] = kInfiniteValue;  // One of 20 is 5 %: the 19th smallest is still finite.
  EXPECT_EQ(SampleQuantile(values, 0.95), 0.1);
  values[8] = kInfiniteValue;
  EXPECT_EQ(SampleQuantile(values, 0.95), kInfiniteValue);
  EXPECT_EQ(SampleQuantile(values, 0.50), 0.1);
}

TEST(Moments, MeanSquareErrorIsSquaredBiasPlusVariance) {
  const RandomStream stream(11);
  std::vector<double> errors;
  for (uint64_t i = 0; i < 1000; ++i) errors.push_back(0.3 + 0.1 * stream.Normal(i));
  const double n = 1000.0;
  const double rmse = RootMeanSquare(errors);
  const double bias = Mean(errors);
  const double s = StandardDeviation(errors);
  // Both sides are sums of 1000 terms near 0.1; rounding grows at most linearly: n ε 0.1 = 2e-14.
  EXPECT_NEAR(rmse * rmse, bias * bias + (n - 1.0) / n * s * s, 2e-14);
  EXPECT_DOUBLE_EQ(StandardErrorOfMean(errors), s / std::sqrt(n));
}

TEST(Moments, AgreeWithSmallClosedForms) {
  const std::vector<double> values = {1.0, 2.0, 6.0};
  EXPECT_DOUBLE_EQ(Mean(values), 3.0);
  EXPECT_DOUBLE_EQ(RootMeanSquare(values), std::sqrt(41.0 / 3.0));
  EXPECT_DOUBLE_EQ(StandardDeviation(values), std::sqrt(7.0));
}

TEST(Moments, TheStandardErrorIsTheSpreadOfTheMean) {
  // Over M means of n normals, M z² / (σ²/n) is χ² with M degrees of freedom, z their deviation
  // from the true mean: within M ± 4 √(2 M), which a true mean leaves with a probability below
  // 2e-4.
  const RandomStream stream(12);
  constexpr int kMeans = 400;
  constexpr int kSize = 25;
  double chi_squared = 0.0;
  double variance_of_mean = 0.0;
  for (uint64_t m = 0; m < kMeans; ++m) {
    std::vector<double> sample;
    for (uint64_t i = 0; i < kSize; ++i) sample.push_back(stream.Child("m", m).Normal(i));
    chi_squared += Mean(sample) * Mean(sample) * kSize;
    variance_of_mean += StandardErrorOfMean(sample) * StandardErrorOfMean(sample) / kMeans;
  }
  EXPECT_NEAR(chi_squared, kMeans, 4.0 * std::sqrt(2.0 * kMeans));
  // s² has the relative variance 2/(n - 1); over M samples 4 sigma are 4 √(2/(24 · 400)) = 5.8 %.
  EXPECT_NEAR(variance_of_mean, 1.0 / kSize, 0.058 / kSize);
}

TEST(Statistics, WhatHasNoAnswerIsAFault) {
  const std::vector<double> none;
  const std::vector<double> one = {1.0};
  EXPECT_THROW(Mean(none), std::logic_error);
  EXPECT_THROW(RootMeanSquare(none), std::logic_error);
  EXPECT_THROW(StandardDeviation(one), std::logic_error);
  EXPECT_THROW(SampleQuantile(none, 0.5), std::logic_error);
  EXPECT_THROW(SampleQuantile(one, 0.0), std::logic_error);
  EXPECT_THROW(SampleQuantile(std::vector<double>{std::nan("")}, 0.5), std::logic_error);
  EXPECT_THROW(ClopperPearson(2, 1), std::logic_error);
  EXPECT_THROW(ClopperPearson(-1, 1), std::logic_error);
  EXPECT_THROW(ClopperPearson(1, 2, 1.0), std::logic_error);
}

}  // namespace
}  // namespace fenestra
