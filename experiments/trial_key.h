#pragma once

#include <compare>

namespace fenestra {

/// One trial of a study.
struct TrialKey {
  int cell = 0;   ///< Index into Cells(study).
  int trial = 0;  ///< Index in the cell, from 0.

  auto operator<=>(const TrialKey&) const = default;
};

}  // namespace fenestra
