#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/row_selection.h"
#include "experiments/study/metric.h"

namespace fenestra {

/// One line of a file of limits: a metric, a limit for it, the rows that it is taken over.
struct Limit {
  std::string text{};  ///< As written.
  int line = 0;        ///< In its file; 0 if it stands in none.
  Metric metric{};
  /// Metric ≤ value, or metric ≥ value.
  bool is_upper = true;
  double value = 0.0;
  /// The value is not the metric's own but that of its ratio (rmse) or difference (rate) to the
  /// same metric in the baseline.
  bool to_baseline = false;
  /// Probability that the limit is not said to hold when it does not.
  double confidence = 0.95;
  /// The metric of every cell is held against the limit, not that of all rows together.
  bool in_each_cell = false;
  std::vector<Condition> where{};
};

}  // namespace fenestra
