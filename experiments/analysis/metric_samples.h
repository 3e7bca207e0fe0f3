#pragma once

#include <optional>
#include <vector>

#include "experiments/analysis/row_context.h"
#include "experiments/statistics/clustered_statistics.h"
#include "experiments/study/metric.h"

namespace fenestra {

/// √ of the mean over rows of the Cramér–Rao variances, of all three directions and of parts.
/// Metres.
struct ErrorBounds {
  double all = 0.0;
  double depth = 0.0;
  double across = 0.0;
};

/// Over the hits; nullopt without hits, and unless all of them have a bound.
std::optional<ErrorBounds> BoundsOfHits(const std::vector<MetricRow>& rows);

/// What one row gives to a metric. In SI units, so that sums are scaled once, when they are done.
struct Sample {
  double value = 0.0;   ///< Of a share: 1 for a row that has it, else 0.
  double weight = 1.0;  ///< What the row counts for; of kOverBound its Cramér–Rao variance.
  ClusterKey cluster{};
  bool is_independent = true;

  double square() const { return value * value; }
};

/// The rows that count for a metric, in their order. Empty where the metric does not exist.
std::vector<Sample> SamplesOf(const std::vector<MetricRow>& rows, const Metric& metric);
std::vector<Sample> IndependentOf(const std::vector<Sample>& samples);

/// The value of a row, signed where the quantity is, in SI units; nullopt where it has none.
std::optional<double> SiValueOf(const MetricRow& row, Quantity quantity);
/// What a value in SI units is multiplied by to be in the metric's unit.
double ScaleOf(const Metric& metric);

/// Samples by cluster. Refers to the samples.
class ClusteredSamples {
 public:
  explicit ClusteredSamples(const std::vector<Sample>& samples);

  const std::vector<Sample>& samples() const { return samples_; }
  size_t clusters() const { return count_; }
  /// Whether every sample is a cluster of its own.
  bool AreIndependent() const { return count_ == samples_.size(); }
  /// Of a sample, counted from 0 in the order in which they first occur.
  size_t ClusterOf(size_t sample) const { return cluster_[sample]; }

  /// Of shares.
  EffectiveCount Effective() const;
  /// Of the values, and of their squares.
  std::vector<ClusterSum> Sums() const;
  std::vector<ClusterSum> SquareSums() const;
  /// ln of the trimmed mean square (kTrimmedRmse) less itself, with the standard error that the
  /// winsorised squares give it. Domain: some square that is left is not 0.
  ClusteredMean TrimmedLogarithm() const;

 private:
  const std::vector<Sample>& samples_;
  std::vector<size_t> cluster_;
  size_t count_ = 0;
};

/// Mean of the squares without the largest kTrimmedShare of them, rounded down.
struct TrimmedSquares {
  double mean = 0.0;
  double largest = 0.0;  ///< Of those that are left.
  size_t left = 0;
};
TrimmedSquares Trim(const std::vector<Sample>& samples);

/// ln of a mean square less itself: 0 with the standard error of the logarithm, to first order.
ClusteredMean Logarithm(const ClusteredMean& mean_square);

}  // namespace fenestra
