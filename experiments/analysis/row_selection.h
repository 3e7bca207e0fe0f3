#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/io/parameter_table.h"
#include "experiments/study/study.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

enum class Comparison { kEqual, kNotEqual, kLess, kAtMost, kGreater, kAtLeast, kIn };

/// `name` is a factor, "detector", "part" or "sensor"; several values for kIn only.
struct Condition {
  std::string name;
  Comparison comparison = Comparison::kEqual;
  std::vector<ParameterValue> values;
};

/// Finds the rows that a bound speaks of. A factor's value in a row is what was drawn in its trial,
/// else the cell's level, else what the study fixes.
class RowSelection {
 public:
  /// Keeps references to both.
  RowSelection(const Study& study, std::span<const Cell> cells);

  /// What is wrong with conditions: a detector, part or sensor that the study does not have, a
  /// factor that concerns none of its parts.
  std::vector<std::string> Objections(std::span<const Condition> where) const;

  bool Matches(const TrialRecord& row, std::span<const Condition> where) const;

  /// Of a factor, "detector", "part" or "sensor"; nullopt where the factor does not concern the
  /// row.
  std::optional<ParameterValue> ValueOf(const TrialRecord& row, const std::string& name) const;

 private:
  bool Matches(const TrialRecord& row, const Condition& condition) const;

  const Study& study_;
  std::span<const Cell> cells_;
};

}  // namespace fenestra
