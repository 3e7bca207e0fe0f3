#pragma once

#include <functional>
#include <optional>
#include <string>

#include "experiments/analysis/metric_tally.h"

namespace fenestra {

/// Whether something is shown with the confidence asked for.
enum class Verdict {
  kHolds,
  kViolated,   ///< The opposite is shown.
  kUndecided,  ///< Neither, with these rows.
};

/// "holds", "VIOLATED", "undecided".
const char* ToString(Verdict verdict);

/// What rows tell of a number that a limit is set for.
struct ConfidenceLimits {
  double estimate = 0.0;  ///< Of that number.
  /// One-sided confidence limits of that number, from `growth` times the clusters with the same
  /// scatter.
  std::function<double(double confidence, double growth)> lower{};
  std::function<double(double confidence, double growth)> upper{};
  /// The number is the metric itself; of a quantile it is the share of the rows within its limit:
  /// p95 ≤ 15 says that this share is at least 0.95. The limit and its sense, translated:
  double limit = 0.0;
  bool is_upper = true;
  int clusters = 0;  ///< Of which the limits are made.
  /// Of shares and quantiles: the rows that have it, and those that count, as independent ones.
  std::optional<EffectiveCount> share{};
  /// Of an rmse: how much of Σ x² the row with the largest one holds.
  std::optional<double> largest_share{};

  bool Holds(double confidence, double growth = 1.0) const;
  bool IsViolated(double level, double growth = 1.0) const;
};

/// A limit for a metric: metric ≤ value, or metric ≥ value.
struct MetricLimit {
  Metric metric;
  double value = 0.0;  ///< In the metric's unit.
  bool is_upper = true;
};

/// Limits as the intervals of MetricTally, one-sided; nullopt where no row counts. Of an rmse (and
/// over its bound) they are Student's t on ln of the mean square, to first order, whose tails reach
/// to the small levels of many tests, as those of 1000 resamples do not. It takes the scatter of
/// the squares for known, which holds for errors that are nearly normal and not where a few rows
/// hold much of the sum (largest_share).
std::optional<ConfidenceLimits> LimitsOf(const MetricTally& tally, const MetricLimit& limit);

/// The same for the number that `shares` are of, each 0 or 1.
ConfidenceLimits ShareLimits(const std::vector<Sample>& shares);
/// Limits of estimate · √exp(x), where x has the mean 0 and the standard error of `logarithm`.
ConfidenceLimits RootLimits(double estimate, const ClusteredMean& logarithm);

}  // namespace fenestra
