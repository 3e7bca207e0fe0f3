#pragma once

#include <string>
#include <vector>

#include "experiments/study/study.h"

namespace fenestra {

/// Settings of a study that are allowed each for itself, but not together.
struct Contradiction {
  size_t part_index;
  /// A factor without whose setting there would be none; empty if no single one is to blame.
  std::string factor;
  std::string message;
};

/// Tries the scene and the sensor of every cell, at the corners of what its distributions may
/// draw (see the .cpp for which), and returns one contradiction for each part and factor.
/// The study must have at most kMostCells cells.
std::vector<Contradiction> FindContradictions(const Study& study);

/// Why a part's rules (until, envelope) cannot work, for people; empty if they can.
std::vector<std::string> RuleObjections(const StudyPart& part);

/// Why the factor cannot matter in the part, for people; empty if it can.
std::string WhyWithoutEffect(const std::string& factor, const StudyPart& part);

}  // namespace fenestra
