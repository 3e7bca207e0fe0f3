#include "experiments/summariser.h"

#include "core/check.h"

namespace fenestra {

void Summariser::Add(const TrialRecord& row) {
  if (row.cell != cell_) {
    FENESTRA_CHECK(row.cell > cell_, "rows must come cell by cell");
    EndCell();
    cell_ = row.cell;
  }
  tallies_[row.detector].Add(row);
}

std::vector<CellSummary> Summariser::Finish() {
  EndCell();
  return std::move(summaries_);
}

void Summariser::EndCell() {
  for (const auto& [detector, tally] : tallies_) summaries_.push_back(tally.Summary());
  tallies_.clear();
}

}  // namespace fenestra
