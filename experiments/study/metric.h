#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/outcome.h"

namespace fenestra {

/// What is measured in each row. The error is estimate minus truth of the centroid, in the frame of
/// the scored camera: x to the right, y down, z in depth.
enum class Quantity {
  kError,   ///< Length of the error [mm].
  kErrorX,  ///< Signed [mm]; likewise the next two.
  kErrorY,
  kErrorZ,
  kErrorAcross,     ///< √(x² + y²) [mm].
  kTime,            ///< Sum of the stage times [ms].
  kErrorOverBound,  ///< |e| / √trace of this trial's Cramér–Rao bound; see docs/theory.md.
  kNormalisedSquare,  ///< eᵀ Σ⁻¹ e with the covariance Σ that the detector states; χ² of 3 if
                      ///< honest.
};

/// "centroid_error_mm", "centroid_error_x_mm", ..., "time_ms", "error_over_bound",
/// "normalised_square".
const char* ToString(Quantity quantity);
const std::vector<Quantity>& AllQuantities();
/// "mm", "ms", or "" for a pure number.
const char* UnitOf(Quantity quantity);

/// The rows that a metric is taken over: its denominator.
enum class CountedRows {
  kAttempts,       ///< The target is wholly in view.
  kWithTarget,     ///< There is a target, in view or not.
  kWithoutTarget,  ///< There is none.
  kHits,
  kBoundedHits,  ///< Hits with a Cramér–Rao bound.
  kHitsWithCovariance,
  kTimed,  ///< With stage times, not crashed.
  kTimedHits,
};

/// A figure of a set of rows. Everything that reports, stopping rules, envelopes, checks and
/// comparisons say of results is one of these; MetricTally computes it with its interval.
///
///     kRate         share of the rows with the outcome
///     kWithin       share of the rows with |quantity| ≤ limit; of the attempts a length is held
///                   against limit · the window's side, and of a wrong window or without an
///                   estimate it is never within
///     kQuantile     of |quantity|; of errors over all attempts, one without an estimate as +∞, so
///                   that declining the hard ones pays nothing
///     kRmse         √(mean of quantity²) over the hits
///     kTrimmedRmse  the same over the hits without the 5 % that are the farthest off: no single
///     row
///                   can hold much of it
///     kBias         mean of the signed quantity over the hits
///     kOverBound    rmse over √(mean of the Cramér–Rao variances) of the same hits; absent unless
///     all
///                   of them have a bound
struct Metric {
  enum class Kind { kRate, kWithin, kQuantile, kRmse, kTrimmedRmse, kBias, kOverBound };

  Kind kind = Kind::kRate;
  Outcome outcome = Outcome::kHit;       ///< Of kRate.
  double level = 0.95;                   ///< Of kQuantile; 0 < level < 1.
  Quantity quantity = Quantity::kError;  ///< Of all but kRate.
  double limit = 0.25;                   ///< Of kWithin.

  bool operator==(const Metric&) const = default;

  bool IsShare() const { return kind == Kind::kRate || kind == Kind::kWithin; }
};

/// The share of the hits that kTrimmedRmse leaves out, rounded down to whole ones: some from 20 on.
inline constexpr double kTrimmedShare = 0.05;
/// 95 % of χ² with three degrees of freedom are below.
inline constexpr double kChiSquare3At95 = 7.814727903;
/// A normal error is this many bounds long less than once in ten million times.
inline constexpr double kFarBounds = 6.0;

CountedRows RowsOf(const Metric& metric);
/// "attempts", "trials with a target", "scenes without a window", "hits", "hits with a bound",
/// "hits with a covariance", "timed trials", "timed hits".
const char* ToString(CountedRows rows);
/// Of its value: "" for shares and ratios.
const char* UnitOf(const Metric& metric);

/// A metric that files, tables and commands know by name.
struct NamedMetric {
  std::string name;  ///< With the unit of its value unless it is a share or a ratio.
  Metric metric;
};

/// All named metrics, in the order of intervals.csv.
const std::vector<NamedMetric>& Metrics();
/// nullopt for any other name.
std::optional<Metric> FindMetric(std::string_view name);
/// "rmse_mm" with "_lower95": "rmse_lower95_mm". A column that belongs to a metric's own.
std::string ColumnOf(std::string_view metric, std::string_view suffix);

/// What a stopping rule may ask for: the names of metrics, and bias_mm for the widest of three
/// axes. The metrics that a name stands for; empty for any other name.
const std::vector<std::string>& StoppingMetrics();
std::vector<std::string> MetricsOfTarget(std::string_view name);

/// What an envelope may require: a share at least, or a quantile of an error at most.
const std::vector<std::string>& RequirementMetrics();

}  // namespace fenestra
