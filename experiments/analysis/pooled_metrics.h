#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/metric_tally.h"
#include "experiments/analysis/row_context.h"
#include "experiments/analysis/row_selection.h"
#include "experiments/study/study.h"

namespace fenestra {

/// Which rows are taken together.
struct Pooling {
  /// Rows that agree in all of these are one group: factors, "part", "sensor", "detector".
  std::vector<std::string> by{"part", "sensor", "detector"};
  std::vector<Condition> where{};      ///< Other rows are left out.
  std::vector<std::string> metrics{};  ///< Names; all if it has none.
};

/// One group of rows, of one cell or of many, with every metric that it has.
struct PooledGroup {
  /// Of the names by which it was made, in their order; nullopt where a factor does not concern it.
  std::vector<std::optional<ParameterValue>> values;
  std::vector<NamedEstimate> metrics;
  double confidence = 0.95;  ///< Of each interval; more where cells could stop early.
};

/// Takes the rows of a result together that agree in some factors. Rows of cells that share their
/// replicates count as one witness each replicate (ClusterKey).
class PooledMetrics {
 public:
  /// Keeps references to study and cells. Throws InputError for a name that is no factor of the
  /// study.
  PooledMetrics(const Study& study, std::span<const Cell> cells, Pooling pooling);

  void Add(const TrialRecord& row);

  /// Numbers rising, words in their alphabet; the first name runs slowest.
  std::vector<PooledGroup> Groups() const;

 private:
  struct Group {
    MetricTally tally;
    double confidence = 0.95;
  };

  Pooling pooling_;
  RowSelection selection_;
  RowContext context_;
  std::map<std::vector<std::optional<ParameterValue>>, Group> groups_;
};

}  // namespace fenestra
