#pragma once

#include <string>
#include <vector>

namespace fenestra {

/// When a cell has had enough trials: as soon as, at one of the looks (see Looks) and for every
/// detector, the interval of each metric is no wider than its width, from end to end; at the latest
/// after the part's repetitions. Of bias_mm, the widest of its three axes counts.
struct StoppingRule {
  struct Target {
    std::string metric;  ///< One of StoppingMetrics().
    double width;        ///< In its unit: of a rate in 0 to 1, otherwise mm.

    bool operator==(const Target&) const = default;
  };

  std::vector<Target> targets;
  int first_look = 20;  ///< Fewer trials tell little of a rate or of a spread.

  bool operator==(const StoppingRule&) const = default;

  /// How often a cell of so many trials at most is looked at.
  int CountLooks(int repetitions) const;
};

}  // namespace fenestra
