#include "experiments/analysis/confidence_limits.h"

#include <algorithm>
#include <cmath>

#include "core/system/check.h"

namespace fenestra {
namespace {

using Kind = Metric::Kind;

ClusteredMean Grown(ClusteredMean mean, double growth) {
  mean.standard_error /= std::sqrt(growth);
  mean.clusters = static_cast<int>(mean.clusters * growth);
  return mean;
}

ConfidenceLimits QuantileLimits(const MetricLimit& limit, std::vector<Sample> samples) {
  const double scale = ScaleOf(limit.metric);
  for (Sample& sample : samples) {
    const double value = scale * sample.value;
    // A quantile at the limit satisfies both senses of it.
    sample.value = (limit.is_upper ? value <= limit.value : value < limit.value) ? 1.0 : 0.0;
  }
  ConfidenceLimits limits = ShareLimits(samples);
  limits.limit = limit.metric.level;
  limits.is_upper = !limit.is_upper;
  return limits;
}

ConfidenceLimits BiasLimits(const std::vector<Sample>& samples, double scale) {
  const ClusteredMean mean = MeanOf(ClusteredSamples(samples).Sums());
  const auto limit = [mean, scale](double probability, double growth) {
    return scale * Grown(mean, growth).Quantile(probability);
  };
  return {.estimate = scale * mean.mean,
          .lower = [limit](double c, double g) { return limit(1.0 - c, g); },
          .upper = [limit](double c, double g) { return limit(c, g); },
          .clusters = mean.clusters};
}

double LargestShare(const std::vector<Sample>& samples) {
  double sum = 0.0;
  double largest = 0.0;
  for (const Sample& sample : samples) {
    sum += sample.square();
    largest = std::max(largest, sample.square());
  }
  return sum > 0.0 ? largest / sum : 0.0;
}

ConfidenceLimits RmseLimits(const Metric& metric, const std::vector<Sample>& samples, double scale) {
  const ClusteredSamples clustered(samples);
  if (metric.kind == Kind::kTrimmedRmse) {
    return RootLimits(scale * std::sqrt(Trim(samples).mean), clustered.TrimmedLogarithm());
  }
  const ClusteredMean mean_square = MeanOf(clustered.SquareSums());
  ConfidenceLimits limits = RootLimits(scale * std::sqrt(mean_square.mean), Logarithm(mean_square));
  limits.largest_share = LargestShare(samples);
  return limits;
}

}  // namespace

const char* ToString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kHolds:
      return "holds";
    case Verdict::kViolated:
      return "VIOLATED";
    case Verdict::kUndecided:
      return "undecided";
  }
  FENESTRA_CHECK(false, "verdict out of range");
}

bool ConfidenceLimits::Holds(double confidence, double growth) const {
  return is_upper ? upper(confidence, growth) <= limit : lower(confidence, growth) >= limit;
}

bool ConfidenceLimits::IsViolated(double level, double growth) const {
  return is_upper ? lower(1.0 - level, growth) > limit : upper(1.0 - level, growth) < limit;
}

ConfidenceLimits ShareLimits(const std::vector<Sample>& shares) {
  const ClusteredSamples clustered(shares);
  const EffectiveCount count = clustered.Effective();
  const auto grown = [count](double growth) {
    return EffectiveCount{count.successes * growth, count.trials * growth, count.clusters * growth};
  };
  double with = 0.0;
  for (const Sample& share : shares) with += share.value;
  return {.estimate = with / static_cast<double>(shares.size()),
          .lower = [grown](double c, double g) { return LowerProportionLimit(grown(g), c); },
          .upper = [grown](double c, double g) { return UpperProportionLimit(grown(g), c); },
          .clusters = static_cast<int>(clustered.clusters()),
          .share = count};
}

ConfidenceLimits RootLimits(double estimate, const ClusteredMean& logarithm) {
  const auto limit = [estimate, logarithm](double probability, double growth) {
    return estimate * std::exp(0.5 * Grown(logarithm, growth).Quantile(probability));
  };
  return {.estimate = estimate,
          .lower = [limit](double c, double g) { return limit(1.0 - c, g); },
          .upper = [limit](double c, double g) { return limit(c, g); },
          .clusters = logarithm.clusters};
}

std::optional<ConfidenceLimits> LimitsOf(const MetricTally& tally, const MetricLimit& limit) {
  const std::vector<Sample> samples = IndependentOf(SamplesOf(tally.rows(), limit.metric));
  if (samples.empty()) return std::nullopt;
  const Kind kind = limit.metric.kind;
  if (kind == Kind::kQuantile) return QuantileLimits(limit, samples);
  const double scale = ScaleOf(limit.metric);
  ConfidenceLimits limits = limit.metric.IsShare() ? ShareLimits(samples)
                        : kind == Kind::kBias  ? BiasLimits(samples, scale)
                                               : RmseLimits(limit.metric, samples, scale);
  limits.limit = limit.value;
  limits.is_upper = limit.is_upper;
  return limits;
}

}  // namespace fenestra
