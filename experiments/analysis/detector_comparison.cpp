#include "experiments/analysis/detector_comparison.h"

namespace fenestra {

void DetectorComparisons::Add(const TrialRecord& record) {
  const Outcome outcome = record.score.outcome;
  if (outcome == Outcome::kOutOfView) return;
  CellTries& cell = cells_[record.cell];
  cell.part = record.part;
  cell.sensor = record.sensor;
  cell.levels = record.levels;
  cell.by_detector[record.detector][record.trial] = {
      .success = outcome == Outcome::kHit || outcome == Outcome::kClear,
      .has_target = record.score.HasTarget(),
      .error_m = record.score.CentroidErrorOrInfinity_m()};
}

DetectorComparison DetectorComparisons::Compare(int cell, const CellTries& tries,
                                                const std::string& first,
                                                const std::string& second) {
  DetectorComparison comparison;
  comparison.cell = cell;
  comparison.part = tries.part;
  comparison.sensor = tries.sensor;
  comparison.levels = tries.levels;
  comparison.first = first;
  comparison.second = second;
  std::vector<double> first_errors;
  std::vector<double> second_errors;
  const Tries& others = tries.by_detector.at(second);
  for (const auto& [trial, a] : tries.by_detector.at(first)) {
    const auto found = others.find(trial);
    if (found == others.end()) continue;
    const Try& b = found->second;
    PairedCounts& counts = comparison.successes;
    ++(a.success ? (b.success ? counts.both : counts.only_first)
                 : (b.success ? counts.only_second : counts.neither));
    if (!a.has_target) continue;
    first_errors.push_back(a.error_m);
    second_errors.push_back(b.error_m);
  }
  comparison.rate_difference_interval = PairedDifferenceInterval(comparison.successes);
  comparison.mcnemar_p =
      ExactMcNemar(comparison.successes.only_first, comparison.successes.only_second);
  comparison.errors = CompareErrors({first_errors, second_errors});
  return comparison;
}

std::vector<DetectorComparison> DetectorComparisons::Comparisons() const {
  std::vector<DetectorComparison> comparisons;
  for (const auto& [cell, tries] : cells_) {
    const auto& detectors = tries.by_detector;
    for (auto first = detectors.begin(); first != detectors.end(); ++first) {
      for (auto second = std::next(first); second != detectors.end(); ++second) {
        DetectorComparison comparison = Compare(cell, tries, first->first, second->first);
        if (comparison.successes.pairs() > 0) comparisons.push_back(std::move(comparison));
      }
    }
  }
  return comparisons;
}

}  // namespace fenestra
