#include "experiments/check/estimation.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "experiments/output/number_format.h"
#include "experiments/statistics/clustered_statistics.h"
#include "experiments/statistics/moments.h"

namespace fenestra {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Sum>
using ByCluster = std::map<std::pair<int, int>, Sum>;

template <typename Sum>
std::vector<Sum> Values(const ByCluster<Sum>& clusters) {
  std::vector<Sum> values;
  for (const auto& [key, value] : clusters) values.push_back(value);
  return values;
}

// The rows that a rate of the outcome is a share of.
bool CountsForRate(const TrialRecord& row, Outcome outcome) {
  const bool of_empty_scenes = outcome == Outcome::kFalseAlarm || outcome == Outcome::kClear;
  return of_empty_scenes ? !row.score.HasTarget() : row.score.IsAttempt();
}

// Signed where the quantity is; nullopt for a row that has none.
std::optional<double> ValueOf(const TrialRecord& row, Quantity quantity) {
  if (quantity == Quantity::kTime) {
    const auto seconds = row.TotalSeconds();
    if (!seconds || row.score.outcome == Outcome::kCrashed) return std::nullopt;
    return 1e3 * *seconds;
  }
  const auto error_C = row.score.CentroidError_C();
  if (!error_C) return std::nullopt;
  switch (quantity) {
    case Quantity::kErrorX:
      return 1e3 * error_C->x();
    case Quantity::kErrorY:
      return 1e3 * error_C->y();
    case Quantity::kErrorZ:
      return 1e3 * error_C->z();
    case Quantity::kErrorAcross:
      return 1e3 * error_C->head<2>().norm();
    default:
      return 1e3 * error_C->norm();
  }
}

const char* UnitOf(Quantity quantity) {
  return quantity == Quantity::kTime ? "ms" : "mm";
}

// Limits of the share that the clusters' successes are.
std::optional<Estimation> ShareOf(const ByCluster<ClusterCount>& clusters) {
  Estimation share;
  double successes = 0.0;
  for (const auto& [key, count] : clusters) {
    successes += count.successes;
    share.rows += count.trials;
    share.clusters += count.trials > 0 ? 1 : 0;
  }
  if (share.rows == 0) return std::nullopt;
  share.estimate = successes / share.rows;
  const EffectiveCount count = Effective(Values(clusters));
  const auto grown = [count](double growth) {
    return EffectiveCount{count.successes * growth, count.trials * growth};
  };
  share.lower = [grown](double confidence, double growth) {
    return LowerProportionLimit(grown(growth), confidence);
  };
  share.upper = [grown](double confidence, double growth) {
    return UpperProportionLimit(grown(growth), confidence);
  };
  return share;
}

std::optional<Estimation> EstimateRate(const Bound& bound, std::span<const SelectedRow> rows) {
  ByCluster<ClusterCount> clusters;
  for (const SelectedRow& row : rows) {
    if (!CountsForRate(*row.row, bound.figure.outcome)) continue;
    ClusterCount& count = clusters[row.cluster];
    ++count.trials;
    count.successes += row.row->score.outcome == bound.figure.outcome ? 1 : 0;
  }
  auto share = ShareOf(clusters);
  if (!share) return share;
  share->limit = bound.limit;
  share->is_upper = bound.is_upper;
  share->shown = Percent(share->estimate);
  return share;
}

std::optional<Estimation> EstimateQuantile(const Bound& bound, std::span<const SelectedRow> rows) {
  const Figure& figure = bound.figure;
  ByCluster<ClusterCount> clusters;
  std::vector<double> values;
  for (const SelectedRow& row : rows) {
    const auto value = ValueOf(*row.row, figure.quantity);
    if (figure.quantity == Quantity::kTime ? !value : !row.row->score.IsAttempt()) continue;
    values.push_back(std::abs(value.value_or(kInfinity)));
    ClusterCount& count = clusters[row.cluster];
    ++count.trials;
    // A quantile at the limit satisfies both senses of the bound.
    const bool within = bound.is_upper ? values.back() <= bound.limit : values.back() < bound.limit;
    count.successes += within ? 1 : 0;
  }
  auto share = ShareOf(clusters);
  if (!share) return share;
  share->limit = figure.level;
  share->is_upper = !bound.is_upper;
  share->shown =
      fmt::format("{} {} ({} within {})", Significant(SampleQuantile(values, figure.level)),
                  UnitOf(figure.quantity), Percent(share->estimate), bound.limit);
  return share;
}

// Clustered mean of a value of each row; rows without a value are left out.
std::optional<ClusteredMean> MeanOfRows(
    std::span<const SelectedRow> rows,
    const std::function<std::optional<double>(const SelectedRow&)>& value, Estimation& counts) {
  ByCluster<ClusterSum> clusters;
  counts.rows = 0;
  for (const SelectedRow& row : rows) {
    const auto x = value(row);
    if (!x) continue;
    ClusterSum& sum = clusters[row.cluster];
    sum.sum += *x;
    ++sum.rows;
    ++counts.rows;
  }
  if (counts.rows == 0) return std::nullopt;
  counts.clusters = static_cast<int>(clusters.size());
  return MeanOf(Values(clusters));
}

ClusteredMean Grown(ClusteredMean mean, double growth) {
  mean.standard_error /= std::sqrt(growth);
  mean.clusters = static_cast<int>(mean.clusters * growth);
  return mean;
}

std::optional<double> HitValue(const TrialRecord& row, Quantity quantity) {
  if (row.score.outcome != Outcome::kHit) return std::nullopt;
  return ValueOf(row, quantity);
}

std::optional<Estimation> EstimateBias(const Bound& bound, std::span<const SelectedRow> rows) {
  Estimation result{.limit = bound.limit, .is_upper = bound.is_upper};
  const Quantity quantity = bound.figure.quantity;
  const auto mean = MeanOfRows(
      rows, [&](const SelectedRow& row) { return HitValue(*row.row, quantity); }, result);
  if (!mean) return std::nullopt;
  result.estimate = mean->mean;
  result.shown = fmt::format("{} {}", Significant(mean->mean), UnitOf(quantity));
  result.lower = [m = *mean](double c, double g) { return Grown(m, g).Quantile(1.0 - c); };
  result.upper = [m = *mean](double c, double g) { return Grown(m, g).Quantile(c); };
  return result;
}

// Limits of √exp(x) times `scale`, where x has the mean 0 and the standard error of `logarithm`.
void SetRootLimits(Estimation& result, const ClusteredMean& logarithm) {
  const auto limit = [e = result.estimate, logarithm](double probability, double growth) {
    return e * std::exp(0.5 * Grown(logarithm, growth).Quantile(probability));
  };
  result.lower = [limit](double c, double g) { return limit(1.0 - c, g); };
  result.upper = [limit](double c, double g) { return limit(c, g); };
}

std::optional<Estimation> EstimateRmse(const Bound& bound, std::span<const SelectedRow> rows) {
  Estimation result{.limit = bound.limit, .is_upper = bound.is_upper};
  const Quantity quantity = bound.figure.quantity;
  const auto square = [&](const SelectedRow& row) -> std::optional<double> {
    const auto value = HitValue(*row.row, quantity);
    return value ? std::optional(*value * *value) : std::nullopt;
  };
  const auto mean_square = MeanOfRows(rows, square, result);
  if (!mean_square) return std::nullopt;
  result.estimate = std::sqrt(mean_square->mean);
  result.shown = fmt::format("{} {}", Significant(result.estimate), UnitOf(quantity));
  ClusteredMean logarithm = *mean_square;
  logarithm.mean = 0.0;
  if (mean_square->mean > 0.0) logarithm.standard_error /= mean_square->mean;
  SetRootLimits(result, logarithm);
  return result;
}

bool BothHit(const SelectedRow& row) {
  return row.row->score.outcome == Outcome::kHit && row.baseline->score.outcome == Outcome::kHit;
}

std::optional<Estimation> EstimateRmseRatio(const Bound& bound, std::span<const SelectedRow> rows) {
  Estimation result{.limit = bound.limit, .is_upper = bound.is_upper};
  const Quantity quantity = bound.figure.quantity;
  const auto square_of = [quantity](const TrialRecord& row) {
    const double value = ValueOf(row, quantity).value_or(0.0);
    return value * value;
  };
  const auto mean_square = [&](bool of_baseline) {
    return MeanOfRows(
        rows,
        [&](const SelectedRow& row) -> std::optional<double> {
          if (!BothHit(row)) return std::nullopt;
          return square_of(of_baseline ? *row.baseline : *row.row);
        },
        result);
  };
  const auto now = mean_square(false);
  const auto before = mean_square(true);
  if (!now || !(now->mean > 0.0) || !(before->mean > 0.0)) return std::nullopt;
  result.estimate = std::sqrt(now->mean / before->mean);
  result.shown = fmt::format("{} times", Significant(result.estimate));
  // ln(a/b) to first order: the mean of a_i/a - b_i/b.
  const auto logarithm = MeanOfRows(
      rows,
      [&](const SelectedRow& row) -> std::optional<double> {
        if (!BothHit(row)) return std::nullopt;
        return square_of(*row.row) / now->mean - square_of(*row.baseline) / before->mean;
      },
      result);
  SetRootLimits(result, *logarithm);
  return result;
}

std::optional<Estimation> EstimateRateDifference(const Bound& bound,
                                                 std::span<const SelectedRow> rows) {
  const Outcome outcome = bound.figure.outcome;
  ByCluster<ClusterCount> gained;
  ByCluster<ClusterCount> lost;
  for (const SelectedRow& row : rows) {
    if (!CountsForRate(*row.row, outcome) || !CountsForRate(*row.baseline, outcome)) continue;
    const bool now = row.row->score.outcome == outcome;
    const bool before = row.baseline->score.outcome == outcome;
    ++gained[row.cluster].trials;
    ++lost[row.cluster].trials;
    gained[row.cluster].successes += now && !before ? 1 : 0;
    lost[row.cluster].successes += before && !now ? 1 : 0;
  }
  const auto up = ShareOf(gained);
  const auto down = ShareOf(lost);
  if (!up) return std::nullopt;
  Estimation result = *up;
  result.estimate = up->estimate - down->estimate;
  result.limit = bound.limit;
  result.is_upper = bound.is_upper;
  result.shown = fmt::format("{:+.1f} points", 100.0 * result.estimate);
  const auto half = [](double confidence) { return 0.5 + 0.5 * confidence; };
  result.lower = [=](double c, double g) {
    return up->lower(half(c), g) - down->upper(half(c), g);
  };
  result.upper = [=](double c, double g) {
    return up->upper(half(c), g) - down->lower(half(c), g);
  };
  return result;
}

}  // namespace

std::optional<Estimation> Estimate(const Bound& bound, std::span<const SelectedRow> rows) {
  switch (bound.figure.kind) {
    case Figure::Kind::kRate:
      return bound.to_baseline ? EstimateRateDifference(bound, rows) : EstimateRate(bound, rows);
    case Figure::Kind::kQuantile:
      return EstimateQuantile(bound, rows);
    case Figure::Kind::kBias:
      return EstimateBias(bound, rows);
    case Figure::Kind::kRmse:
      return bound.to_baseline ? EstimateRmseRatio(bound, rows) : EstimateRmse(bound, rows);
  }
  return std::nullopt;
}

}  // namespace fenestra
