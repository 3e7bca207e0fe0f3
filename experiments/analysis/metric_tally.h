#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/metric_samples.h"
#include "experiments/analysis/row_context.h"
#include "experiments/statistics/moments.h"
#include "experiments/study/metric.h"

namespace fenestra {

/// A metric of some rows.
struct MetricEstimate {
  double value = 0.0;  ///< In the metric's unit, over all rows that count.
  int count = 0;       ///< Of a share: the rows that have it.
  int of = 0;          ///< The rows that count.
  int clusters = 0;    ///< The independent witnesses among them, of which the interval is made.
  /// Two-sided; nullopt where there are too few of them.
  std::optional<Interval> interval{};
  /// Of a bias; likewise.
  std::optional<double> standard_error{};
  /// "Clopper-Pearson", "order statistics", "Student", "bootstrap", "Student of the logarithm";
  /// with
  /// ", clustered" where rows share random numbers.
  std::string method{};
};

/// Collects rows, of one cell or of many, and computes metrics of them with their intervals;
/// nothing else does.
///
/// Values are over all rows that count for a metric (RowsOf). Intervals are over the independent
/// ones (MetricRow::is_independent), and rows with one ClusterKey count as one witness:
///
///     metric             every row a cluster of its own    several rows in a cluster
///     share              Clopper and Pearson, exact        the same for the effective number of
///     rows
///                                                          (Korn and Graubard 1998)
///     quantile           order statistics, exact           inverted limits of shares (Woodruff
///     1952) bias               Student's t                       t of a ratio of cluster sums
///     rmse, over bound   bootstrap of ln of the mean       the same, of whole clusters
///                        square, studentised
///     trimmed rmse       t of ln of the trimmed mean       the same with cluster sums
///                        square, its deviation that of the
///                        winsorised squares
///
/// Sources: statistics/intervals.h, clustered_statistics.h, clustered_intervals.h; of the last row
/// J. W. Tukey and D. H. McLaughlin, "Less vulnerable confidence and significance procedures for
/// location based on a single sample: trimming/winsorization 1", Sankhyā A 25, 1963. The same
/// limits one-sided: LimitsOf.
class MetricTally {
 public:
  void Add(const MetricRow& row) { rows_.push_back(row); }

  const std::vector<MetricRow>& rows() const { return rows_; }

  /// nullopt where no row counts.
  std::optional<MetricEstimate> Estimate(const Metric& metric, double confidence = 0.95) const;

 private:
  std::vector<MetricRow> rows_;
};

/// A metric that has a name, of some rows.
struct NamedEstimate {
  std::string name;
  MetricEstimate estimate;
};

/// All named metrics that exist, or those of them that are wanted, in the order of Metrics().
std::vector<NamedEstimate> EstimatesOf(const MetricTally& tally, double confidence = 0.95,
                                       const std::vector<std::string>& wanted = {});
/// nullptr where there is none of this name.
const MetricEstimate* Find(const std::vector<NamedEstimate>& estimates, std::string_view name);

}  // namespace fenestra
