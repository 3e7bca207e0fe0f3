#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/cell_summary.h"
#include "experiments/analysis/row_context.h"

namespace fenestra {

/// Adds up the rows of one cell under one detector. Of each row it keeps a few numbers, not the
/// row: a cell of 10^5 trials takes some tens of megabytes.
class CellTally {
 public:
  /// Rows must come in the order of their trials, so that sums have the same bits whoever makes
  /// them. A trial that occurs twice, or a row of another cell, fails a check.
  void Add(const TrialRecord& row, const RowContext& context);

  /// Domain: at least one row.
  CellSummary Summary() const;

 private:
  void AddTimes(const TrialRecord& row);

  CellSummary counted_;  ///< What needs no more than counting.
  int last_trial_ = -1;
  MetricTally metrics_;
  std::map<std::pair<Outcome, std::string>, int> reasons_;
  std::vector<std::string> stages_;  ///< In the order in which they first occur.
  std::map<std::string, std::vector<double>> stage_seconds_;
};

/// Makes summaries of rows that come one at a time: cell by cell, and in each by trial, as
/// ResultStore::ForEachRow gives them. Holds the numbers of one cell only.
class Summariser {
 public:
  /// The context says which rows share random numbers; without one, each row is independent.
  explicit Summariser(RowContext context = {}) : context_(std::move(context)) {}

  void Add(const TrialRecord& row);
  /// One summary per (cell, detector), ordered by cell, then detector.
  std::vector<CellSummary> Finish();

 private:
  void EndCell();

  RowContext context_;
  int cell_ = -1;
  std::map<std::string, CellTally> tallies_;  ///< Of this cell, by detector.
  std::vector<CellSummary> summaries_;
};

/// One summary per (cell, detector), ordered by cell, then detector. Does not depend on the order
/// of the rows, to the last bit. A (cell, trial, detector) that occurs twice fails a check. See
/// Summariser for rows that are not all in memory.
std::vector<CellSummary> Summarise(std::span<const TrialRecord> records, RowContext context = {});

}  // namespace fenestra
