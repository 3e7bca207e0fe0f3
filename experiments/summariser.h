#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/cell_tally.h"

namespace fenestra {

/// Makes summaries of rows that come one at a time: cell by cell, and in each by trial, as
/// ResultStore::ForEachRow gives them. Holds the numbers of one cell only.
class Summariser {
 public:
  void Add(const TrialRecord& row);
  /// One summary per (cell, detector), ordered by cell, then detector.
  std::vector<CellSummary> Finish();

 private:
  void EndCell();

  int cell_ = -1;
  std::map<std::string, CellTally> tallies_;  ///< Of this cell, by detector.
  std::vector<CellSummary> summaries_;
};

}  // namespace fenestra
