#include "experiments/statistics/paired.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/random/random_stream.h"
#include "core/system/check.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

// Tango's score for the hypothesis that the difference is d: positive where the data lie above it.
//
//     z(d) = (b - c - n d) / √(n (2 q + d (1 - d)))
//
// with q the restricted maximum likelihood estimate of the probability of only_second: the larger
// root of 2n q² - (b + c - (2n - b + c) d) q - c d (1 - d) = 0.
double Score(const PairedCounts& counts, double d) {
  const double n = counts.pairs();
  const double b = counts.only_first;
  const double c = counts.only_second;
  const double linear = -b - c + (2.0 * n - b + c) * d;
  const double constant = -c * d * (1.0 - d);
  const double root = std::sqrt(std::max(0.0, linear * linear - 8.0 * n * constant));
  const double q = (root - linear) / (4.0 * n);
  const double variance = n * (2.0 * q + d * (1.0 - d));
  const double distance = b - c - n * d;
  if (!(variance > 0.0)) {
    return distance == 0.0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), distance);
  }
  return distance / std::sqrt(variance);
}

// Where the score, which falls from `from` to `to`, is z; an end where it does not get there.
double WhereScoreIs(const PairedCounts& counts, double z, double from, double to) {
  const auto excess = [&](double d) { return Score(counts, d) - z; };
  if (!(excess(from) > 0.0)) return from;
  if (!(excess(to) < 0.0)) return to;
  double low = from;
  double high = to;
  // Bisection: 60 halvings of at most 2 leave less than a rounding of 1.
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

constexpr size_t kMostEnumerated = 16;
constexpr size_t kMostResampled = 2000;
constexpr int kSignFlips = 19'999;
constexpr uint64_t kSeed = 1;

// Sums that differ by rounding alone count as equal.
double Slack(double sum_of_magnitudes) {
  return 1e-12 * sum_of_magnitudes;
}

}  // namespace

double ExactMcNemar(int only_first, int only_second) {
  FENESTRA_CHECK(only_first >= 0 && only_second >= 0, "counts");
  const int discordant = only_first + only_second;
  if (discordant == 0) return 1.0;
  const boost::math::binomial_distribution<double> fair(discordant, 0.5);
  return std::min(1.0, 2.0 * cdf(fair, std::min(only_first, only_second)));
}

Interval PairedDifferenceInterval(const PairedCounts& counts, double confidence) {
  FENESTRA_CHECK(0.0 < confidence && confidence < 1.0, "confidence");
  if (counts.pairs() == 0) return {.lower = -1.0, .upper = 1.0};
  const double z =
      quantile(boost::math::normal_distribution<double>(), 1.0 - (1.0 - confidence) / 2.0);
  const double estimate = counts.difference();
  return {.lower = WhereScoreIs(counts, z, -1.0, estimate),
          .upper = WhereScoreIs(counts, -z, estimate, 1.0)};
}

ErrorComparison CompareErrors(const PairedErrors& errors, double confidence) {
  FENESTRA_CHECK(errors.first.size() == errors.second.size(), "pairs of errors");
  ErrorComparison comparison;
  comparison.pairs = static_cast<int>(errors.first.size());
  std::vector<double> differences;
  for (size_t i = 0; i < errors.first.size(); ++i) {
    const double a = errors.first[i];
    const double b = errors.second[i];
    FENESTRA_CHECK(a >= 0.0 && b >= 0.0, "an error is a distance");
    comparison.first_nearer += a < b ? 1 : 0;
    comparison.second_nearer += b < a ? 1 : 0;
    if (std::isfinite(a) && std::isfinite(b)) differences.push_back(a - b);
  }
  comparison.sign_test_p = ExactMcNemar(comparison.first_nearer, comparison.second_nearer);
  comparison.both_finite = static_cast<int>(differences.size());
  comparison.mean_difference_interval = MeanInterval(differences, confidence);
  if (comparison.mean_difference_interval) comparison.mean_difference = Mean(differences);
  return comparison;
}

double SignFlipPValue(std::span<const double> differences) {
  std::vector<double> d;
  double sum = 0.0;
  double magnitudes = 0.0;
  double squares = 0.0;
  for (const double x : differences) {
    if (x == 0.0) continue;
    d.push_back(x);
    sum += x;
    magnitudes += std::abs(x);
    squares += x * x;
  }
  if (d.empty()) return 1.0;
  const double observed = sum - Slack(magnitudes);
  if (d.size() > kMostResampled) {
    return boost::math::cdf(
        boost::math::complement(boost::math::normal(), sum / std::sqrt(squares)));
  }
  if (d.size() <= kMostEnumerated) {
    const uint64_t assignments = uint64_t{1} << d.size();
    uint64_t at_least = 0;
    for (uint64_t signs = 0; signs < assignments; ++signs) {
      double flipped = 0.0;
      for (size_t i = 0; i < d.size(); ++i) flipped += (signs >> i & 1) != 0 ? d[i] : -d[i];
      at_least += flipped >= observed ? 1 : 0;
    }
    return static_cast<double>(at_least) / static_cast<double>(assignments);
  }
  const RandomStream stream(kSeed);
  uint64_t at_least = 1;  // The observed one.
  std::vector<float> uniforms(d.size());
  for (int b = 0; b < kSignFlips; ++b) {
    stream.Child("signs", static_cast<uint64_t>(b)).FillUniforms(uniforms);
    double flipped = 0.0;
    for (size_t i = 0; i < d.size(); ++i) flipped += uniforms[i] < 0.5f ? d[i] : -d[i];
    at_least += flipped >= observed ? 1 : 0;
  }
  return static_cast<double>(at_least) / (kSignFlips + 1.0);
}

}  // namespace fenestra
