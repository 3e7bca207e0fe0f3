#include "experiments/statistics/intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/system/check.h"

namespace fenestra {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// With 1000 resamples the ends of a 95 % interval are the 25th value from either side: their own
// spread is a fifth of the distance to the next nominal percent.
constexpr int kResamples = 1000;

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

struct MeanSquare {
  double log;    // ln m
  double error;  // s / (m √n), the standard error of ln m
};

// The root mean square of all squares, or of those at the resampled places.
template <typename At>
std::optional<MeanSquare> MeanSquareOf(size_t n, At at) {
  double sum = 0.0;
  for (size_t i = 0; i < n; ++i) sum += at(i);
  const double mean = sum / static_cast<double>(n);
  double deviations = 0.0;
  for (size_t i = 0; i < n; ++i) deviations += (at(i) - mean) * (at(i) - mean);
  if (!(mean > 0.0) || !(deviations > 0.0)) return std::nullopt;
  const double count = static_cast<double>(n);
  return MeanSquare{std::log(mean), std::sqrt(deviations / (count - 1.0) / count) / mean};
}

std::vector<double> StudentisedResamples(std::span<const double> squares, const MeanSquare& whole,
                                         const RandomStream& resampling) {
  const size_t n = squares.size();
  std::vector<float> uniforms(n);
  std::vector<size_t> places(n);
  std::vector<double> taus;
  for (uint64_t b = 0; b < kResamples; ++b) {
    resampling.Child("resample", b).FillUniforms(uniforms);
    for (size_t i = 0; i < n; ++i) {
      places[i] = std::min(
          n - 1, static_cast<size_t>(static_cast<double>(uniforms[i]) * static_cast<double>(n)));
    }
    const auto resample = MeanSquareOf(n, [&](size_t i) { return squares[places[i]]; });
    if (resample) taus.push_back((resample->log - whole.log) / resample->error);
  }
  return taus;
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

std::optional<Interval> RootMeanSquareInterval(std::span<const double> values,
                                               const RandomStream& resampling, double confidence) {
  CheckConfidence(confidence);
  if (values.size() < kFewestForRms) return std::nullopt;
  std::vector<double> squares;
  for (const double x : values) squares.push_back(x * x);
  const auto whole = MeanSquareOf(squares.size(), [&](size_t i) { return squares[i]; });
  if (!whole) return std::nullopt;
  const double tail = (1.0 - confidence) / 2.0;
  const auto taus = squares.size() < kManyForRms ? StudentisedResamples(squares, *whole, resampling)
                                                 : std::vector<double>();
  const auto tau = [&](double p) {
    if (taus.empty()) return quantile(boost::math::normal_distribution<double>(), p);
    return SampleQuantile(taus, p);
  };
  const double low = whole->log - whole->error * tau(1.0 - tail);
  const double high = whole->log - whole->error * tau(tail);
  return Interval{.lower = std::exp(0.5 * low), .upper = std::exp(0.5 * high)};
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
