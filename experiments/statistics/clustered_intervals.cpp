#include "experiments/statistics/clustered_intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>

#include "core/system/check.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();
// With 1000 resamples the ends of a 95 % interval are the 25th value from either side: their own
// spread is a fifth of the distance to the next nominal percent.
constexpr int kResamples = 1000;

std::vector<ClusterCount> Sizes(std::span<const ClusteredValue> values) {
  std::vector<ClusterCount> counts;
  for (const ClusteredValue& row : values) {
    if (counts.size() <= row.cluster) counts.resize(row.cluster + 1);
    ++counts[row.cluster].trials;
  }
  return counts;
}

struct MeanSquare {
  double log;    // ln m
  double error;  // Standard error of ln m.
};

// Of all clusters, or of those at the resampled places: m = Σ s / Σ w, and to first order
// error = √(Σ (s - m w)² / (r - 1) / r) / (w̄ m).
template <typename At>
std::optional<MeanSquare> MeanSquareOf(size_t r, At at) {
  const double clusters = static_cast<double>(r);
  double sum = 0.0;
  double weight = 0.0;
  for (size_t i = 0; i < r; ++i) {
    sum += at(i).sum;
    weight += at(i).weight;
  }
  const double mean = sum / weight;
  double deviations = 0.0;
  for (size_t i = 0; i < r; ++i) {
    const double deviation = at(i).sum - mean * at(i).weight;
    deviations += deviation * deviation;
  }
  if (!(mean > 0.0) || !(deviations > 0.0)) return std::nullopt;
  const double error = std::sqrt(deviations / (clusters - 1.0) / clusters);
  return MeanSquare{std::log(mean), error / (weight / clusters) / mean};
}

std::vector<double> StudentisedResamples(std::span<const ClusterSum> clusters,
                                         const MeanSquare& whole, const RandomStream& resampling) {
  const size_t r = clusters.size();
  std::vector<float> uniforms(r);
  std::vector<size_t> places(r);
  std::vector<double> taus;
  for (uint64_t b = 0; b < kResamples; ++b) {
    resampling.Child("resample", b).FillUniforms(uniforms);
    for (size_t i = 0; i < r; ++i) {
      places[i] = std::min(
          r - 1, static_cast<size_t>(static_cast<double>(uniforms[i]) * static_cast<double>(r)));
    }
    const auto resample = MeanSquareOf(r, [&](size_t i) { return clusters[places[i]]; });
    if (resample) taus.push_back((resample->log - whole.log) / resample->error);
  }
  return taus;
}

}  // namespace

Interval ClusteredQuantileInterval(std::span<const ClusteredValue> values, double p,
                                   double confidence) {
  std::vector<ClusterCount> counts = Sizes(values);
  std::vector<ClusteredValue> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.value < b.value; });
  if (std::all_of(counts.begin(), counts.end(), [](const auto& c) { return c.trials <= 1; })) {
    std::vector<double> plain;
    for (const ClusteredValue& row : sorted) plain.push_back(row.value);
    return QuantileInterval(plain, p, confidence);
  }
  const double one_sided = 1.0 - (1.0 - confidence) / 2.0;
  Interval interval{.lower = kNoEnd, .upper = kNoEnd};
  // Whether the quantile may lie below all values: none of them counts then.
  ClusterMoments moments = MomentsOf(counts);
  const bool open = UpperProportionLimit(moments.Effective(), one_sided) >= p;
  if (open) interval.lower = -kNoEnd;
  for (size_t i = 0; i < sorted.size(); ++i) {
    moments.AddSuccess(counts[sorted[i].cluster]);
    ++counts[sorted[i].cluster].successes;
    const double x = sorted[i].value;
    if (i + 1 < sorted.size() && sorted[i + 1].value == x) continue;
    const EffectiveCount share = moments.Effective();
    if (interval.lower == kNoEnd && UpperProportionLimit(share, one_sided) >= p) {
      interval.lower = x;
    }
    if (LowerProportionLimit(share, one_sided) >= p) {
      interval.upper = x;
      break;
    }
  }
  return interval;
}

std::optional<Interval> ClusteredRmsInterval(std::span<const ClusterSum> clusters,
                                             const RandomStream& resampling, double confidence) {
  FENESTRA_CHECK(0.0 < confidence && confidence < 1.0, fmt::format("{}", confidence));
  if (clusters.size() < kFewestForRms) return std::nullopt;
  const auto whole = MeanSquareOf(clusters.size(), [&](size_t i) { return clusters[i]; });
  if (!whole) return std::nullopt;
  const double tail = (1.0 - confidence) / 2.0;
  const auto taus = clusters.size() < kManyForRms
                        ? StudentisedResamples(clusters, *whole, resampling)
                        : std::vector<double>();
  const auto tau = [&](double p) {
    if (taus.empty()) return quantile(boost::math::normal_distribution<double>(), p);
    return SampleQuantile(taus, p);
  };
  const double low = whole->log - whole->error * tau(1.0 - tail);
  const double high = whole->log - whole->error * tau(tail);
  return Interval{.lower = std::exp(0.5 * low), .upper = std::exp(0.5 * high)};
}

std::optional<Interval> RootMeanSquareInterval(std::span<const double> values,
                                               const RandomStream& resampling, double confidence) {
  std::vector<ClusterSum> squares;
  for (const double x : values) squares.push_back({.sum = x * x, .weight = 1.0});
  return ClusteredRmsInterval(squares, resampling, confidence);
}

}  // namespace fenestra
