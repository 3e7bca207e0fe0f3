#include "experiments/analysis/envelope_search.h"

#include <algorithm>
#include <set>

#include "core/system/check.h"

namespace fenestra {
namespace {

using Verdicts = std::span<const std::optional<Verdict>>;

std::vector<size_t> TestedLevels(Verdicts verdicts) {
  std::vector<size_t> tested;
  for (size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i]) tested.push_back(i);
  }
  return tested;
}

// The largest power of two that leaves at least kFirstIntervals steps, so that halving ends at 1.
size_t FirstStep(size_t levels) {
  size_t step = 1;
  while (2 * step * kFirstIntervals <= levels - 1) step *= 2;
  return step;
}

std::vector<size_t> FirstLevels(size_t levels) {
  std::vector<size_t> first;
  for (size_t i = 0; i + 1 < levels; i += FirstStep(levels)) first.push_back(i);
  first.push_back(levels - 1);
  return first;
}

bool Holds(const std::optional<Verdict>& verdict) {
  return verdict == Verdict::kHolds;
}

}  // namespace

std::vector<LevelCurve> LevelCurves(const Study& study, std::span<const Cell> cells) {
  std::vector<LevelCurve> curves;
  for (const Cell& cell : cells) {
    const auto& rule = study.parts[cell.part_index].envelope;
    if (!rule) continue;
    FactorValues others;
    std::optional<double> level;
    for (const auto& [name, value] : cell.levels) {
      if (name == rule->over) {
        level = std::get<double>(value);
      } else {
        others.emplace_back(name, value);
      }
    }
    FENESTRA_CHECK(level.has_value(), "an envelope over a factor without levels");
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const LevelCurve& c) {
      return c.part_index == cell.part_index && c.sensor == cell.sensor && c.others == others;
    });
    if (curve == curves.end()) {
      curves.push_back({cell.part_index, cell.part, cell.sensor, others, {}, {}});
      curve = curves.end() - 1;
    }
    curve->level.push_back(*level);
    curve->cell.push_back(cell.index);
  }
  return curves;
}

std::vector<size_t> NextLevels(size_t levels, const CurveVerdicts& verdicts) {
  std::set<size_t> next;
  for (const size_t level : FirstLevels(levels)) {
    const bool tested = !verdicts.empty() && verdicts.begin()->second[level].has_value();
    if (!tested) next.insert(level);
  }
  if (!next.empty()) return {next.begin(), next.end()};
  for (const auto& [detector, at] : verdicts) {
    const std::vector<size_t> tested = TestedLevels(at);
    for (size_t i = 1; i < tested.size(); ++i) {
      const size_t low = tested[i - 1];
      const size_t high = tested[i];
      if (high - low > 1 && Holds(at[low]) != Holds(at[high])) next.insert((low + high) / 2);
    }
  }
  return {next.begin(), next.end()};
}

std::vector<HoldingRange> HoldingRanges(const LevelCurve& curve, Verdicts verdicts) {
  std::vector<HoldingRange> ranges;
  std::optional<double> before;  // The last level that was tested and does not hold.
  bool inside = false;
  for (const size_t i : TestedLevels(verdicts)) {
    const double level = curve.level[i];
    if (Holds(verdicts[i])) {
      if (!inside) {
        ranges.push_back({.from = level, .to = level, .fails_below = before, .fails_above = {}});
      }
      ranges.back().to = level;
      inside = true;
    } else {
      if (inside) ranges.back().fails_above = level;
      inside = false;
      before = level;
    }
  }
  return ranges;
}

}  // namespace fenestra
