#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "experiments/bounds/bound.h"
#include "experiments/study.h"
#include "experiments/trial_record.h"

namespace fenestra {

/// Finds the rows that a bound speaks of. A factor's value in a row is what was drawn in its trial,
/// else the cell's level, else what the study fixes.
class RowSelection {
 public:
  explicit RowSelection(const Study& study);

  /// Throws InputError unless the conditions' detectors, parts and sensors occur in the study and
  /// its factors concern a part.
  void Check(const std::string& source, std::span<const Bound> bounds) const;

  bool Matches(const TrialRecord& row, std::span<const Condition> where) const;

  /// Rows with the same key share random numbers: those of a replicate, in all cells, or, with
  /// independent cells, those of a trial.
  std::pair<int, int> Cluster(const TrialRecord& row) const;

 private:
  bool Matches(const TrialRecord& row, const Condition& condition) const;
  std::optional<ParameterValue> ValueOf(const TrialRecord& row, const std::string& name) const;

  Study study_;
  std::vector<Cell> cells_;
};

}  // namespace fenestra
