#include "experiments/study/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

// Φ by the standard library, not by Boost.
double Phi(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

double Cdf(const UniformDistribution& d, double x) {
  return (x - d.min) / (d.max - d.min);
}
double Cdf(const LogUniformDistribution& d, double x) {
  return std::log(x / d.min) / std::log(d.max / d.min);
}
double Cdf(const TriangularDistribution& d, double x) {
  const double range = d.max - d.min;
  if (x <= d.mode) return (x - d.min) * (x - d.min) / (range * (d.mode - d.min));
  return 1.0 - (d.max - x) * (d.max - x) / (range * (d.max - d.mode));
}
double Cdf(const TruncatedNormalDistribution& d, double x) {
  // Φ keeps its digits below the mean: limits above it are mirrored.
  if (d.min > d.mean)
    return 1.0 - Cdf(TruncatedNormalDistribution{-d.mean, d.sd, -d.max, -d.min}, -x);
  const auto below = [&d](double at) { return Phi((at - d.mean) / d.sd); };
  return (below(x) - below(d.min)) / (below(d.max) - below(d.min));
}
double Cdf(const Distribution& distribution, double x) {
  return std::visit([x](const auto& d) { return Cdf(d, x); }, distribution);
}

const std::vector<Distribution> kExamples{
    UniformDistribution{-3.0, 5.0},
    LogUniformDistribution{10.0, 1e5},
    TriangularDistribution{-1.0, 0.5, 4.0},
    TruncatedNormalDistribution{1.0, 2.0, -1.0, 4.0},
    TruncatedNormalDistribution{0.0, 1.0, 4.5, 6.0},    // the upper tail
    TruncatedNormalDistribution{0.0, 1.0, -6.0, -4.5},  // the lower tail
};

TEST(Distribution, QuantileInvertsTheClosedForm) {
  for (const Distribution& distribution : kExamples) {
    double previous = Lowest(distribution);
    for (double p = 0.001; p < 1.0; p += 0.001) {
      const double x = Quantile(distribution, p);
      // Φ's relative error of some 1e-16 times x·dx = 6 σ². Without the care for tails, whose mass
      // is 3e-6 beyond 4.5 σ, an absolute error of 1e-16 would grow to 3e-11.
      EXPECT_NEAR(Cdf(distribution, x), p, 1e-12);
      EXPECT_GT(x, previous);
      previous = x;
    }
  }
}

TEST(Distribution, QuantilesEndWhereTheSupportEnds) {
  for (const Distribution& distribution : kExamples) {
    EXPECT_EQ(Quantile(distribution, 0.0), Lowest(distribution));
    EXPECT_EQ(Quantile(distribution, 1.0), Highest(distribution));
    EXPECT_GE(Quantile(distribution, 0x1p-54), Lowest(distribution));
    EXPECT_LE(Quantile(distribution, 1.0 - 0x1p-53), Highest(distribution));
  }
}

TEST(Distribution, TruncationMirrors) {
  const TruncatedNormalDistribution upper{0.0, 1.0, 4.5, 6.0};
  const TruncatedNormalDistribution lower{0.0, 1.0, -6.0, -4.5};
  for (double p = 0.01; p < 1.0; p += 0.01) {
    // 1 - p rounds to 1.1e-16; dx/dp is at most 1 / density ≈ 10 in the tail.
    EXPECT_NEAR(Quantile(upper, p), -Quantile(lower, 1.0 - p), 1e-14);
  }
}

TEST(Distribution, TriangularMayPeakAtAnEnd) {
  // P(X ≤ x) = 1 − (1 − x)² and x²: closed quantiles.
  for (double p = 0.01; p < 1.0; p += 0.01) {
    EXPECT_NEAR(Quantile(TriangularDistribution{0.0, 0.0, 1.0}, p), 1.0 - std::sqrt(1.0 - p),
                1e-15);
    EXPECT_NEAR(Quantile(TriangularDistribution{0.0, 1.0, 1.0}, p), std::sqrt(p), 1e-15);
  }
}

TEST(Distribution, NormalMassKeepsItsDigitsInTheTails) {
  // P(X > 10 σ) = 7.619853024160527e-24 (Abramowitz & Stegun, table 26.2, and Mathematica).
  EXPECT_NEAR(NormalMass(0.0, 1.0, 10.0, INFINITY) / 7.619853024160527e-24, 1.0, 1e-12);
  EXPECT_NEAR(NormalMass(0.0, 1.0, -INFINITY, -10.0) / 7.619853024160527e-24, 1.0, 1e-12);
  EXPECT_NEAR(NormalMass(5.0, 2.0, 3.0, 7.0), std::erf(1.0 / std::sqrt(2.0)), 1e-15);
}

constexpr int kDraws = 40'000;

// √n times the largest distance between the draws' empirical CDF and `expected`.
double KolmogorovSmirnov(const Distribution& drawn, const Distribution& expected) {
  const RandomStream stream(7);
  std::vector<double> draws(kDraws);
  for (size_t i = 0; i < draws.size(); ++i) draws[i] = Quantile(drawn, stream.Uniform(i));
  std::sort(draws.begin(), draws.end());
  double distance = 0.0;
  for (size_t i = 0; i < draws.size(); ++i) {
    const double cdf = Cdf(expected, draws[i]);
    distance = std::max({distance, cdf - static_cast<double>(i) / kDraws,
                         static_cast<double>(i + 1) / kDraws - cdf});
  }
  return std::sqrt(static_cast<double>(kDraws)) * distance;
}

// P(√n D > t) ≤ 2 exp(−2 t²) (Massart 1990): 1e-6 for each of the six.
const double kThreshold = std::sqrt(0.5 * std::log(2.0 / 1e-6));

TEST(Distribution, DrawsFollowTheirDistribution) {
  for (const Distribution& distribution : kExamples) {
    EXPECT_LT(KolmogorovSmirnov(distribution, distribution), kThreshold);
  }
}

// The twin: Φ(x) and Φ(x / 1.1) differ by up to 0.023 (at x = 1.05), and 200 · 0.023 = 4.6 is far
// above the threshold of 2.7.
TEST(Distribution, DrawsOfAWrongSpreadAreRejected) {
  EXPECT_GT(KolmogorovSmirnov(TruncatedNormalDistribution{0.0, 1.1, -6.0, 6.0},
                              TruncatedNormalDistribution{0.0, 1.0, -6.0, 6.0}),
            kThreshold);
  EXPECT_GT(KolmogorovSmirnov(UniformDistribution{1.0, 2.0}, LogUniformDistribution{1.0, 2.0}),
            kThreshold);
}

}  // namespace
}  // namespace fenestra
