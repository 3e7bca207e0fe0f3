#include "experiments/statistics/intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/system/check.h"

namespace fenestra {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void CheckConfidence(double confidence) {
  FENESTRA_CHECK(0.0 < confidence && confidence < 1.0, fmt::format("{}", confidence));
}

// The largest number of values that fewer of than α/2 of samples have below the quantile.
int LowerRank(int n, double p, double tail) {
  const boost::math::binomial_distribution<double> below(n, p);
  int rank = 0;
  while (rank < n && cdf(below, rank) <= tail) ++rank;
  return rank;
}

}  // namespace

Interval QuantileInterval(std::span<const double> values, double p, double confidence) {
  CheckConfidence(confidence);
  FENESTRA_CHECK(0.0 < p && p < 1.0, fmt::format("p = {}", p));
  FENESTRA_CHECK(std::none_of(values.begin(), values.end(), [](double x) { return std::isnan(x); }),
                 "NaN has no rank");
  Interval interval{.lower = -kInfinity, .upper = kInfinity};
  if (values.empty()) return interval;
  const auto n = static_cast<int>(values.size());
  const double tail = (1.0 - confidence) / 2.0;
  const int lower = LowerRank(n, p, tail);
  // P(Bin(n, p) ≥ u) = P(Bin(n, 1 - p) ≤ n - u): the same from the other end.
  const int upper = n + 1 - LowerRank(n, 1.0 - p, tail);
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  if (lower >= 1) interval.lower = sorted[static_cast<size_t>(lower - 1)];
  if (upper <= n) interval.upper = sorted[static_cast<size_t>(upper - 1)];
  return interval;
}

std::optional<Interval> MeanInterval(std::span<const double> values, double confidence) {
  CheckConfidence(confidence);
  if (values.size() < 2) return std::nullopt;
  const boost::math::students_t_distribution<double> t(static_cast<double>(values.size() - 1));
  const double mean = Mean(values);
  const double half = quantile(t, 1.0 - (1.0 - confidence) / 2.0) * StandardErrorOfMean(values);
  return Interval{.lower = mean - half, .upper = mean + half};
}

std::vector<int> Looks(int first, int most) {
  FENESTRA_CHECK(first >= 1 && most >= 1, "looks at no trials");
  std::vector<int> looks;
  for (int trials = first; trials < most; trials += std::max(1, trials / 2)) {
    looks.push_back(trials);
    if (trials > most - trials / 2) break;  // The next one would be beyond.
  }
  looks.push_back(most);
  return looks;
}

double LookConfidence(double confidence, int looks) {
  FENESTRA_CHECK(0.0 < confidence && confidence < 1.0 && looks >= 1, "confidence of looks");
  return 1.0 - (1.0 - confidence) / looks;
}

}  // namespace fenestra
