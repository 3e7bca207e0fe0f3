#include "experiments/summary.h"

#include <algorithm>
#include <tuple>

#include "experiments/summariser.h"

namespace fenestra {

std::optional<double> HitErrors::OverBound() const {
  return bounds ? std::optional(rmse / bounds->all) : std::nullopt;
}

std::optional<double> HitErrors::DepthOverBound() const {
  return bounds ? std::optional(rmse_depth / bounds->depth) : std::nullopt;
}

Proportion MakeProportion(int count, int of) {
  return {.count = count, .of = of, .interval95 = ClopperPearson(count, of, 0.95)};
}

std::vector<CellSummary> Summarise(std::span<const TrialRecord> records) {
  std::vector<const TrialRecord*> rows;
  rows.reserve(records.size());
  for (const TrialRecord& record : records) rows.push_back(&record);
  std::sort(rows.begin(), rows.end(), [](const TrialRecord* a, const TrialRecord* b) {
    return std::tie(a->cell, a->trial) < std::tie(b->cell, b->trial);
  });
  Summariser summariser;
  for (const TrialRecord* row : rows) summariser.Add(*row);
  return summariser.Finish();
}

}  // namespace fenestra
