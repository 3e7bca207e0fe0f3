#pragma once

#include <string>
#include <vector>

namespace fenestra {

/// A figure of a cell whose interval shall become narrow.
enum class StoppingFigure { kHitRate, kFalseAlarmRate, kP50Error, kP95Error, kBias, kRmse };

inline constexpr StoppingFigure kAllStoppingFigures[] = {
    StoppingFigure::kHitRate,  StoppingFigure::kFalseAlarmRate, StoppingFigure::kP50Error,
    StoppingFigure::kP95Error, StoppingFigure::kBias,           StoppingFigure::kRmse};

/// "hit_rate", "false_alarm_rate", "p50_error_mm", "p95_error_mm", "bias_mm", "rmse_mm".
const char* ToString(StoppingFigure figure);

/// When a cell has had enough trials: as soon as, at one of the looks (see Looks) and for every
/// detector, the interval of each figure is no wider than its width, from end to end; at the latest
/// after the part's repetitions. Of the bias, the widest of its three axes counts.
struct StoppingRule {
  struct Target {
    StoppingFigure figure;
    double width;  ///< As the figure's name says: of a rate in 0 to 1, otherwise mm.

    bool operator==(const Target&) const = default;
  };

  std::vector<Target> targets;
  int first_look = 20;  ///< Fewer trials tell little of a rate or of a spread.

  bool operator==(const StoppingRule&) const = default;

  /// How often a cell of so many trials at most is looked at.
  int CountLooks(int repetitions) const;
};

}  // namespace fenestra
