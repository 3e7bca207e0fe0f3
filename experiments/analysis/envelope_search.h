#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/confidence_limits.h"
#include "experiments/study/study.h"

namespace fenestra {

/// The cells of one part and sensor that differ in the level of one factor alone.
struct LevelCurve {
  size_t part_index = 0;
  std::string part;
  SensorKind sensor = SensorKind::kStereo;
  FactorValues others;        ///< The levels they share.
  std::vector<double> level;  ///< Of the factor, rising.
  std::vector<int> cell;      ///< Index of the cell at each level.
};

/// All curves of the parts that look for an envelope, in the order of their first cells.
std::vector<LevelCurve> LevelCurves(const Study& study, std::span<const Cell> cells);

/// What the finished cells of a curve gave: per detector the verdict at each level, absent where
/// the cell has not been run to its end.
using CurveVerdicts = std::map<std::string, std::vector<std::optional<Verdict>>>;

/// Which levels to run next, by index: first about a quarter of the range apart, both ends among
/// them; then, wherever two neighbours of those that were run differ in whether the requirement
/// holds, the one in the middle, until such neighbours stand side by side. Empty when done.
/// So a boundary is found to one level if the first levels are dense enough to see the region; an
/// island between two of them would be missed.
std::vector<size_t> NextLevels(size_t levels, const CurveVerdicts& verdicts);

/// Consecutive levels that were run and where the requirement holds.
struct HoldingRange {
  double from = 0.0;
  double to = 0.0;
  std::optional<double> fails_below;  ///< The next level that was run, if there is one.
  std::optional<double> fails_above;
};

/// The envelope along one curve for one detector.
struct EnvelopeCurve {
  LevelCurve curve;
  std::string detector;
  std::vector<HoldingRange> holds;  ///< Rising; mostly one or none.
  int tested_levels = 0;
  int trials = 0;
};

/// From how many levels on the first ones are spread.
inline constexpr size_t kFirstIntervals = 4;

std::vector<HoldingRange> HoldingRanges(const LevelCurve& curve,
                                        std::span<const std::optional<Verdict>> verdicts);

}  // namespace fenestra
