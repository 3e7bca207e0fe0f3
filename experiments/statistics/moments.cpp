#include "experiments/statistics/moments.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <vector>

#include "core/system/check.h"

namespace fenestra {
namespace {

void RequireAtLeast(size_t needed, std::span<const double> values) {
  FENESTRA_CHECK(values.size() >= needed, fmt::format("{} values", values.size()));
}

}  // namespace

Interval ClopperPearson(int successes, int trials, double confidence) {
  FENESTRA_CHECK(0 <= successes && successes <= trials, fmt::format("{} of {}", successes, trials));
  FENESTRA_CHECK(0.0 < confidence && confidence < 1.0, fmt::format("{}", confidence));
  if (trials == 0) return {};
  using Binomial = boost::math::binomial_distribution<double>;
  const double one_sided = (1.0 - confidence) / 2.0;
  constexpr auto kMethod = Binomial::clopper_pearson_exact_interval;
  return {.lower = Binomial::find_lower_bound_on_p(trials, successes, one_sided, kMethod),
          .upper = Binomial::find_upper_bound_on_p(trials, successes, one_sided, kMethod)};
}

Interval OneSidedLimits(int successes, int trials, double confidence) {
  return ClopperPearson(successes, trials, std::max(1e-9, 1.0 - 2.0 * (1.0 - confidence)));
}

double SampleQuantile(std::span<const double> values, double p) {
  RequireAtLeast(1, values);
  FENESTRA_CHECK(0.0 < p && p <= 1.0, fmt::format("p = {}", p));
  FENESTRA_CHECK(std::none_of(values.begin(), values.end(), [](double x) { return std::isnan(x); }),
                 "NaN has no rank");
  const double n = static_cast<double>(values.size());
  // n p may round to the wrong side of a whole number (100 · 0.07 = 7.000000000000001), whereas
  // k / n rounds to the same double as the decimal p does; so the comparison decides.
  double k = std::ceil(n * p);
  while (k > 1.0 && (k - 1.0) / n >= p) --k;
  while (k < n && k / n < p) ++k;
  std::vector<double> sorted(values.begin(), values.end());
  const auto ranked = sorted.begin() + static_cast<std::ptrdiff_t>(k) - 1;
  std::nth_element(sorted.begin(), ranked, sorted.end());
  return *ranked;
}

double Mean(std::span<const double> values) {
  RequireAtLeast(1, values);
  double sum = 0.0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

double RootMeanSquare(std::span<const double> values) {
  RequireAtLeast(1, values);
  double sum = 0.0;
  for (const double x : values) sum += x * x;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double StandardDeviation(std::span<const double> values) {
  RequireAtLeast(2, values);
  const double mean = Mean(values);
  double sum = 0.0;
  for (const double x : values) sum += (x - mean) * (x - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double StandardErrorOfMean(std::span<const double> values) {
  return StandardDeviation(values) / std::sqrt(static_cast<double>(values.size()));
}

}  // namespace fenestra
