#include "experiments/check/estimation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/number_format.h"

namespace fenestra {
namespace {

using Kind = Metric::Kind;

// A row that holds more than this of a mean square decides alone what the rmse is.
constexpr double kDominatingShare = 0.2;

std::string WithUnit(double value, const Metric& metric) {
  const std::string unit = UnitOf(metric);
  return Significant(value) + (unit.empty() ? "" : " " + unit);
}

std::string ShownOf(const Limit& limit, const MetricEstimate& estimate, const MetricTally& tally) {
  const Metric& metric = limit.metric;
  if (metric.IsShare()) return Percent(estimate.value);
  if (metric.kind != Kind::kQuantile) return WithUnit(estimate.value, metric);
  int within = 0;
  const double scale = ScaleOf(metric);
  for (const Sample& sample : SamplesOf(tally.rows(), metric)) {
    const double value = scale * sample.value;
    within += (limit.is_upper ? value <= limit.value : value < limit.value) ? 1 : 0;
  }
  return fmt::format("{} ({} within {})", WithUnit(estimate.value, metric),
                     Percent(static_cast<double>(within) / estimate.of), limit.value);
}

std::string IntervalText(const Metric& metric, const std::optional<Interval>& interval) {
  if (!interval) return "";
  if (metric.IsShare()) return Percent(*interval);
  return fmt::format("{} to {}", Significant(interval->lower), Significant(interval->upper));
}

std::string WarningOf(double largest_share, Quantity quantity) {
  if (largest_share <= kDominatingShare) return "";
  return fmt::format(
      "one row holds {:.0f} % of the mean square: what holds of an rmse is told of nearly normal "
      "errors; p95({}) or trimmed_rmse({}) is not decided by single rows",
      100.0 * largest_share, ToString(quantity), ToString(quantity));
}

std::optional<Estimation> EstimateMetric(const Limit& limit, std::span<const SelectedRow> rows) {
  MetricTally tally;
  for (const SelectedRow& row : rows) tally.Add(row.now);
  const auto estimate = tally.Estimate(limit.metric);
  auto limits = LimitsOf(tally, {limit.metric, limit.value, limit.is_upper});
  if (!estimate || !limits) return std::nullopt;
  const double largest_share = limits->largest_share.value_or(0.0);
  return Estimation{.limits = std::move(*limits),
                    .rows = estimate->of,
                    .shown = ShownOf(limit, *estimate, tally),
                    .interval = IntervalText(limit.metric, estimate->interval),
                    .warning = WarningOf(largest_share, limit.metric.quantity)};
}

// Values of pairs that both hit, with the clusters of their rows.
template <typename Value>
std::vector<Sample> OfPairsOfHits(std::span<const SelectedRow> rows, Quantity quantity,
                                  Value value) {
  std::vector<Sample> samples;
  for (const SelectedRow& row : rows) {
    if (!row.now.is_independent || row.now.outcome != Outcome::kHit ||
        row.before->outcome != Outcome::kHit) {
      continue;
    }
    const double now = SiValueOf(row.now, quantity).value_or(0.0);
    const double before = SiValueOf(*row.before, quantity).value_or(0.0);
    samples.push_back({.value = value(now, before), .cluster = row.now.cluster});
  }
  return samples;
}

double LargestOverSum(const std::vector<Sample>& squares) {
  double sum = 0.0;
  double largest = 0.0;
  for (const Sample& sample : squares) {
    sum += sample.value;
    largest = std::max(largest, sample.value);
  }
  return sum > 0.0 ? largest / sum : 0.0;
}

std::optional<Estimation> EstimateRmseRatio(const Limit& limit, std::span<const SelectedRow> rows) {
  const Quantity quantity = limit.metric.quantity;
  const auto now = OfPairsOfHits(rows, quantity, [](double a, double) { return a * a; });
  const auto before = OfPairsOfHits(rows, quantity, [](double, double b) { return b * b; });
  if (now.empty()) return std::nullopt;
  const double mean_now = MeanOf(ClusteredSamples(now).Sums()).mean;
  const double mean_before = MeanOf(ClusteredSamples(before).Sums()).mean;
  if (!(mean_now > 0.0) || !(mean_before > 0.0)) return std::nullopt;
  // ln(a/b) to first order: the mean of a_i/a - b_i/b.
  const auto logarithms = OfPairsOfHits(
      rows, quantity, [&](double a, double b) { return a * a / mean_now - b * b / mean_before; });
  const double ratio = std::sqrt(mean_now / mean_before);
  const ClusteredMean logarithm = MeanOf(ClusteredSamples(logarithms).Sums());
  Estimation result{
      .limits = RootLimits(ratio, logarithm),
      .rows = static_cast<int>(now.size()),
      .shown = fmt::format("{} times", Significant(ratio)),
      .warning = WarningOf(std::max(LargestOverSum(now), LargestOverSum(before)), quantity)};
  result.interval = fmt::format("{} to {}", Significant(result.limits.lower(0.975, 1.0)),
                                Significant(result.limits.upper(0.975, 1.0)));
  result.limits.limit = limit.value;
  result.limits.is_upper = limit.is_upper;
  return result;
}

// Which of the pairs that count for a rate are counted now (or before) and not at the other time.
std::vector<Sample> OnlyAt(bool now, const Metric& rate, std::span<const SelectedRow> rows) {
  std::vector<Sample> samples;
  for (const SelectedRow& row : rows) {
    const std::vector<Sample> of_now = SamplesOf({row.now}, rate);
    const std::vector<Sample> of_before = SamplesOf({*row.before}, rate);
    if (!row.now.is_independent || of_now.empty() || of_before.empty()) continue;
    const bool has_now = of_now.front().value != 0.0;
    const bool had = of_before.front().value != 0.0;
    samples.push_back({.value = (now ? has_now && !had : had && !has_now) ? 1.0 : 0.0,
                       .cluster = row.now.cluster});
  }
  return samples;
}

std::optional<Estimation> EstimateRateDifference(const Limit& limit,
                                                 std::span<const SelectedRow> rows) {
  const std::vector<Sample> gained = OnlyAt(true, limit.metric, rows);
  const std::vector<Sample> lost = OnlyAt(false, limit.metric, rows);
  if (gained.empty()) return std::nullopt;
  double net = 0.0;
  for (size_t i = 0; i < gained.size(); ++i) net += gained[i].value - lost[i].value;
  const ConfidenceLimits up = ShareLimits(gained);
  const ConfidenceLimits down = ShareLimits(lost);
  Estimation result{.limits = up, .rows = static_cast<int>(gained.size())};
  result.shown = fmt::format("{:+.1f} points", 100.0 * net / static_cast<double>(gained.size()));
  const auto half = [](double confidence) { return 0.5 + 0.5 * confidence; };
  result.limits.lower = [=](double c, double g) {
    return up.lower(half(c), g) - down.upper(half(c), g);
  };
  result.limits.upper = [=](double c, double g) {
    return up.upper(half(c), g) - down.lower(half(c), g);
  };
  result.interval =
      fmt::format("{:+.1f} to {:+.1f} points", 100.0 * result.limits.lower(0.975, 1.0),
                  100.0 * result.limits.upper(0.975, 1.0));
  result.limits.estimate = net / static_cast<double>(gained.size());
  result.limits.limit = limit.value;
  result.limits.is_upper = limit.is_upper;
  return result;
}

}  // namespace

std::optional<Estimation> Estimate(const Limit& limit, std::span<const SelectedRow> rows) {
  if (!limit.to_baseline) return EstimateMetric(limit, rows);
  return limit.metric.IsShare() ? EstimateRateDifference(limit, rows)
                                : EstimateRmseRatio(limit, rows);
}

}  // namespace fenestra
