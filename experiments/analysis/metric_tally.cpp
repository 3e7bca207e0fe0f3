#include "experiments/analysis/metric_tally.h"

#include <algorithm>
#include <cmath>

#include "core/random/random_stream.h"
#include "core/system/check.h"
#include "experiments/statistics/clustered_intervals.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

using Kind = Metric::Kind;

std::vector<double> ValuesOf(const std::vector<Sample>& samples) {
  std::vector<double> values;
  for (const Sample& sample : samples) values.push_back(sample.value);
  return values;
}

int CountOf(const std::vector<Sample>& shares) {
  return static_cast<int>(
      std::count_if(shares.begin(), shares.end(), [](const Sample& s) { return s.value != 0.0; }));
}

double RootOfBound(const std::vector<MetricRow>& rows, Quantity quantity) {
  const ErrorBounds bounds = *BoundsOfHits(rows);
  return quantity == Quantity::kErrorZ ? bounds.depth : bounds.all;
}

// In SI units.
double ValueOf(const Metric& metric, const std::vector<Sample>& samples,
               const std::vector<MetricRow>& rows) {
  switch (metric.kind) {
    case Kind::kRate:
    case Kind::kWithin:
      return static_cast<double>(CountOf(samples)) / static_cast<double>(samples.size());
    case Kind::kQuantile:
      return SampleQuantile(ValuesOf(samples), metric.level);
    case Kind::kBias:
      return Mean(ValuesOf(samples));
    case Kind::kRmse:
      return RootMeanSquare(ValuesOf(samples));
    case Kind::kTrimmedRmse:
      return std::sqrt(Trim(samples).mean);
    case Kind::kOverBound:
      return RootMeanSquare(ValuesOf(samples)) / RootOfBound(rows, metric.quantity);
  }
  FENESTRA_CHECK(false, "kind out of range");
}

const char* MethodOf(Kind kind) {
  switch (kind) {
    case Kind::kRate:
    case Kind::kWithin:
      return "Clopper-Pearson";
    case Kind::kQuantile:
      return "order statistics";
    case Kind::kBias:
      return "Student";
    case Kind::kRmse:
    case Kind::kOverBound:
      return "bootstrap";
    case Kind::kTrimmedRmse:
      return "Student of the logarithm";
  }
  FENESTRA_CHECK(false, "kind out of range");
}

Interval ShareInterval(const ClusteredSamples& shares, double confidence) {
  if (shares.AreIndependent()) {
    return ClopperPearson(CountOf(shares.samples()), static_cast<int>(shares.samples().size()),
                          confidence);
  }
  const EffectiveCount count = shares.Effective();
  const double one_sided = 1.0 - (1.0 - confidence) / 2.0;
  return {.lower = LowerProportionLimit(count, one_sided),
          .upper = UpperProportionLimit(count, one_sided)};
}

Interval QuantileIntervalOf(const ClusteredSamples& samples, double level, double confidence) {
  std::vector<ClusteredValue> values;
  for (size_t i = 0; i < samples.samples().size(); ++i) {
    values.push_back({samples.samples()[i].value, samples.ClusterOf(i)});
  }
  const Interval interval = ClusteredQuantileInterval(values, level, confidence);
  // A length is not negative: that nothing bounds its quantile from below says that 0 does.
  return {.lower = std::max(0.0, interval.lower), .upper = interval.upper};
}

std::optional<Interval> RmsIntervalOf(const ClusteredSamples& samples, double confidence) {
  // The same resampling everywhere: equal rows give equal figures.
  return ClusteredRmsInterval(samples.SquareSums(), RandomStream(0).Child("rms_interval"),
                              confidence);
}

std::optional<Interval> TrimmedInterval(const ClusteredSamples& samples, double confidence) {
  const double mean = Trim(samples.samples()).mean;
  if (samples.clusters() < kFewestForRms || !(mean > 0.0)) return std::nullopt;
  const Interval log = samples.TrimmedLogarithm().TwoSided(confidence);
  return Interval{.lower = std::sqrt(mean) * std::exp(0.5 * log.lower),
                  .upper = std::sqrt(mean) * std::exp(0.5 * log.upper)};
}

// In SI units.
std::optional<Interval> IntervalOf(const Metric& metric, const ClusteredSamples& samples,
                                   double confidence) {
  if (samples.clusters() == 0) return std::nullopt;
  switch (metric.kind) {
    case Kind::kRate:
    case Kind::kWithin:
      return ShareInterval(samples, confidence);
    case Kind::kQuantile:
      return QuantileIntervalOf(samples, metric.level, confidence);
    case Kind::kBias:
      if (samples.clusters() < 2) return std::nullopt;
      return MeanOf(samples.Sums()).TwoSided(confidence);
    case Kind::kRmse:
    case Kind::kOverBound:
      return RmsIntervalOf(samples, confidence);
    case Kind::kTrimmedRmse:
      return TrimmedInterval(samples, confidence);
  }
  FENESTRA_CHECK(false, "kind out of range");
}

}  // namespace

std::optional<MetricEstimate> MetricTally::Estimate(const Metric& metric, double confidence) const {
  const std::vector<Sample> samples = SamplesOf(rows_, metric);
  if (samples.empty()) return std::nullopt;
  const std::vector<Sample> independent = IndependentOf(samples);
  const ClusteredSamples clustered(independent);
  const double scale = ScaleOf(metric);
  MetricEstimate estimate{.value = scale * ValueOf(metric, samples, rows_),
                          .count = metric.IsShare() ? CountOf(samples) : 0,
                          .of = static_cast<int>(samples.size()),
                          .clusters = static_cast<int>(clustered.clusters()),
                          .interval = IntervalOf(metric, clustered, confidence),
                          .standard_error = {},
                          .method = MethodOf(metric.kind)};
  if (estimate.interval) {
    estimate.interval->lower *= scale;
    estimate.interval->upper *= scale;
  }
  if (metric.kind == Kind::kBias && clustered.clusters() >= 2) {
    estimate.standard_error = scale * MeanOf(clustered.Sums()).standard_error;
  }
  if (!clustered.AreIndependent()) estimate.method += ", clustered";
  return estimate;
}

std::vector<NamedEstimate> EstimatesOf(const MetricTally& tally, double confidence,
                                       const std::vector<std::string>& wanted) {
  std::vector<NamedEstimate> estimates;
  for (const NamedMetric& named : Metrics()) {
    const bool is_wanted =
        wanted.empty() || std::find(wanted.begin(), wanted.end(), named.name) != wanted.end();
    if (!is_wanted) continue;
    if (auto estimate = tally.Estimate(named.metric, confidence)) {
      estimates.push_back({named.name, std::move(*estimate)});
    }
  }
  return estimates;
}

const MetricEstimate* Find(const std::vector<NamedEstimate>& estimates, std::string_view name) {
  for (const NamedEstimate& named : estimates) {
    if (named.name == name) return &named.estimate;
  }
  return nullptr;
}

}  // namespace fenestra
