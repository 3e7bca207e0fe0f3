#include "experiments/analysis/metric_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/system/check.h"

namespace fenestra {
namespace {

using Kind = Metric::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool IsHit(const MetricRow& row) {
  return row.IsAttempt() && row.outcome == Outcome::kHit;
}

bool Counts(const MetricRow& row, CountedRows rows) {
  switch (rows) {
    case CountedRows::kAttempts:
      return row.IsAttempt();
    case CountedRows::kWithTarget:
      return row.has_target;
    case CountedRows::kWithoutTarget:
      return !row.has_target;
    case CountedRows::kHits:
      return IsHit(row);
    case CountedRows::kBoundedHits:
      return IsHit(row) && row.bound_variances_C;
    case CountedRows::kHitsWithCovariance:
      return IsHit(row) && row.normalised_square;
    case CountedRows::kTimed:
      return row.seconds.has_value();
    case CountedRows::kTimedHits:
      return IsHit(row) && row.seconds;
  }
  FENESTRA_CHECK(false, "rows out of range");
}

// Whether a row is within the limit of kWithin; nullopt where that is unknown.
std::optional<bool> IsWithin(const MetricRow& row, const Metric& metric) {
  const auto value = SiValueOf(row, metric.quantity);
  if (RowsOf(metric) != CountedRows::kAttempts) {
    return value && ScaleOf(metric) * std::abs(*value) <= metric.limit;
  }
  if (!row.side_m) return std::nullopt;
  // The error as a whole is that of a hit; a part of it may be within where the whole is not.
  const bool of_target = row.outcome == Outcome::kHit ||
                         (row.outcome == Outcome::kGross && metric.quantity != Quantity::kError);
  return of_target && value && std::abs(*value) <= metric.limit * *row.side_m;
}

std::optional<double> ValueFor(const MetricRow& row, const Metric& metric) {
  if (metric.kind == Kind::kRate) return row.outcome == metric.outcome ? 1.0 : 0.0;
  if (metric.kind == Kind::kWithin) {
    const auto within = IsWithin(row, metric);
    return within ? std::optional(*within ? 1.0 : 0.0) : std::nullopt;
  }
  const auto value = SiValueOf(row, metric.quantity);
  if (metric.kind == Kind::kQuantile) return std::abs(value.value_or(kInfinity));
  FENESTRA_CHECK(value.has_value(), "a hit without an error");
  return value;
}

double WeightFor(const MetricRow& row, const Metric& metric) {
  if (metric.kind != Kind::kOverBound) return 1.0;
  const Eigen::Vector3d& variances = *row.bound_variances_C;
  return metric.quantity == Quantity::kErrorZ ? variances.z() : variances.sum();
}

}  // namespace

std::optional<ErrorBounds> BoundsOfHits(const std::vector<MetricRow>& rows) {
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();
  int hits = 0;
  for (const MetricRow& row : rows) {
    if (!IsHit(row)) continue;
    if (!row.bound_variances_C) return std::nullopt;
    variances += *row.bound_variances_C;
    ++hits;
  }
  if (hits == 0) return std::nullopt;
  variances /= hits;
  return ErrorBounds{.all = std::sqrt(variances.sum()),
                     .depth = std::sqrt(variances.z()),
                     .across = std::sqrt(variances.head<2>().sum())};
}

std::vector<Sample> SamplesOf(const std::vector<MetricRow>& rows, const Metric& metric) {
  std::vector<Sample> samples;
  const CountedRows counted = RowsOf(metric);
  for (const MetricRow& row : rows) {
    if (!Counts(row, counted)) continue;
    // A ratio of two means is one of the same rows.
    if (metric.kind == Kind::kOverBound && !row.bound_variances_C) return {};
    const auto value = ValueFor(row, metric);
    if (!value) continue;
    samples.push_back({.value = *value,
                       .weight = WeightFor(row, metric),
                       .cluster = row.cluster,
                       .is_independent = row.is_independent});
  }
  return samples;
}

std::vector<Sample> IndependentOf(const std::vector<Sample>& samples) {
  std::vector<Sample> independent;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(independent),
               [](const Sample& sample) { return sample.is_independent; });
  return independent;
}

std::optional<double> SiValueOf(const MetricRow& row, Quantity quantity) {
  if (quantity == Quantity::kTime) return row.seconds;
  if (quantity == Quantity::kNormalisedSquare) return row.normalised_square;
  if (!row.error_C) return std::nullopt;
  switch (quantity) {
    case Quantity::kErrorX:
      return row.error_C->x();
    case Quantity::kErrorY:
      return row.error_C->y();
    case Quantity::kErrorZ:
      return row.error_C->z();
    case Quantity::kErrorAcross:
      return row.error_C->head<2>().norm();
    case Quantity::kErrorOverBound:
      if (!row.bound_variances_C) return std::nullopt;
      return row.error_C->norm() / std::sqrt(row.bound_variances_C->sum());
    default:
      return row.error_C->norm();
  }
}

double ScaleOf(const Metric& metric) {
  return *UnitOf(metric) == '\0' ? 1.0 : 1e3;
}

ClusteredSamples::ClusteredSamples(const std::vector<Sample>& samples) : samples_(samples) {
  std::map<ClusterKey, size_t> known;
  for (const Sample& sample : samples) {
    cluster_.push_back(known.try_emplace(sample.cluster, known.size()).first->second);
  }
  count_ = known.size();
}

EffectiveCount ClusteredSamples::Effective() const {
  std::vector<ClusterCount> counts(count_);
  for (size_t i = 0; i < samples_.size(); ++i) {
    ++counts[cluster_[i]].trials;
    counts[cluster_[i]].successes += samples_[i].value != 0.0 ? 1 : 0;
  }
  return fenestra::Effective(counts);
}

std::vector<ClusterSum> ClusteredSamples::Sums() const {
  std::vector<ClusterSum> sums(count_);
  for (size_t i = 0; i < samples_.size(); ++i) {
    sums[cluster_[i]].sum += samples_[i].value;
    sums[cluster_[i]].weight += samples_[i].weight;
  }
  return sums;
}

std::vector<ClusterSum> ClusteredSamples::SquareSums() const {
  std::vector<ClusterSum> sums(count_);
  for (size_t i = 0; i < samples_.size(); ++i) {
    sums[cluster_[i]].sum += samples_[i].square();
    sums[cluster_[i]].weight += samples_[i].weight;
  }
  return sums;
}

ClusteredMean ClusteredSamples::TrimmedLogarithm() const {
  const TrimmedSquares trimmed = Trim(samples_);
  std::vector<ClusterSum> winsorised(count_);
  for (size_t i = 0; i < samples_.size(); ++i) {
    winsorised[cluster_[i]].sum += std::min(samples_[i].square(), trimmed.largest);
    winsorised[cluster_[i]].weight += 1.0;
  }
  ClusteredMean mean = MeanOf(winsorised);
  mean.standard_error *= static_cast<double>(samples_.size()) / static_cast<double>(trimmed.left);
  mean.mean = trimmed.mean;
  return Logarithm(mean);
}

TrimmedSquares Trim(const std::vector<Sample>& samples) {
  std::vector<double> squares;
  for (const Sample& sample : samples) squares.push_back(sample.square());
  std::sort(squares.begin(), squares.end());
  const double n = static_cast<double>(squares.size());
  squares.resize(squares.size() - static_cast<size_t>(std::floor(kTrimmedShare * n)));
  return {.mean = Mean(squares), .largest = squares.back(), .left = squares.size()};
}

ClusteredMean Logarithm(const ClusteredMean& mean_square) {
  ClusteredMean logarithm = mean_square;
  logarithm.mean = 0.0;
  if (mean_square.mean > 0.0) logarithm.standard_error /= mean_square.mean;
  return logarithm;
}

}  // namespace fenestra
