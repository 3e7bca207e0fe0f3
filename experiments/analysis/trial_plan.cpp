#include "experiments/analysis/trial_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/system/check.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

// How soon one of an envelope's cells may be given up.
constexpr int kFirstEnvelopeLook = 10;

// The widest interval of the metrics that a target names; infinite where one is missing.
double WidthOf(const std::string& target, const MetricTally& tally, double confidence) {
  double widest = 0.0;
  for (const std::string& name : MetricsOfTarget(target)) {
    const auto estimate = tally.Estimate(FindMetric(name).value(), confidence);
    if (!estimate || !estimate->interval) return std::numeric_limits<double>::infinity();
    // From infinity to infinity there is nothing left to narrow, but nothing is known either.
    const double width = estimate->interval->upper - estimate->interval->lower;
    if (std::isnan(width)) return std::numeric_limits<double>::infinity();
    widest = std::max(widest, width);
  }
  return widest;
}

std::vector<int> LooksOf(const StudyPart& part) {
  if (part.until) return Looks(part.until->first_look, part.repetitions);
  if (part.envelope) return Looks(kFirstEnvelopeLook, part.repetitions);
  return {part.repetitions};
}

}  // namespace

bool IsNarrowEnough(const StoppingRule& rule, const MetricTally& tally, double confidence) {
  return std::all_of(rule.targets.begin(), rule.targets.end(), [&](const auto& target) {
    return WidthOf(target.metric, tally, confidence) <= target.width;
  });
}

TrialPlan::TrialPlan(const Study& study, std::span<const Cell> cells)
    : study_(study), cells_(cells), context_(study, cells), curves_(LevelCurves(study, cells)) {
  for (const Cell& cell : cells) {
    CellState state;
    state.looks = LooksOf(study.parts[cell.part_index]);
    state.stored.resize(static_cast<size_t>(cell.repetitions));
    states_.push_back(std::move(state));
    most_trials_ += cell.repetitions;
  }
}

void TrialPlan::Add(const TrialRecord& row) {
  const auto index = static_cast<size_t>(row.cell);
  CellState& state = states_.at(index);
  const auto trial = static_cast<size_t>(row.trial);
  FENESTRA_CHECK(trial < state.stored.size(), "a trial beyond the study's");
  if (!state.stored[trial]) {
    state.stored[trial] = true;
    if (row.trial == state.complete) {
      if (!state.ended && state.complete == state.looks[state.look]) {
        state.ended = StandingOf(index).ended;
        if (!state.ended) ++state.look;
      }
      ++state.complete;
    }
  }
  if (row.trial + 1 != state.complete) return;  // Trials before it are missing.
  const StudyPart& part = study_.parts[cells_[index].part_index];
  if (part.until) state.tallies[row.detector].Add(context_.Of(row));
  if (part.envelope) {
    state.counts.try_emplace(row.detector, *part.envelope).first->second.Add(context_.Of(row));
  }
}

bool TrialPlan::MayEnd(const Cell& cell, const CellState& state) const {
  const StudyPart& part = study_.parts[cell.part_index];
  if (part.until) {
    const double confidence = context_.Confidence(cell.index);
    return std::all_of(state.tallies.begin(), state.tallies.end(), [&](const auto& entry) {
      return IsNarrowEnough(*part.until, entry.second, confidence);
    });
  }
  const int further = cell.repetitions - state.complete;
  return std::none_of(state.counts.begin(), state.counts.end(),
                      [further](const auto& entry) { return entry.second.CanHoldAfter(further); });
}

TrialPlan::Standing TrialPlan::StandingOf(size_t cell) const {
  const CellState& state = states_[cell];
  const int look = state.looks[state.look];
  if (state.ended) return {.ended = true, .wanted = state.complete};
  if (state.complete < look) return {.ended = false, .wanted = look};
  const bool last = state.look + 1 == state.looks.size();
  if (last || MayEnd(cells_[cell], state)) return {.ended = true, .wanted = state.complete};
  return {.ended = false, .wanted = state.looks[state.look + 1]};
}

CurveVerdicts TrialPlan::VerdictsOf(const LevelCurve& curve) const {
  CurveVerdicts verdicts;
  for (size_t level = 0; level < curve.cell.size(); ++level) {
    const auto cell = static_cast<size_t>(curve.cell[level]);
    if (!StandingOf(cell).ended) continue;
    for (const auto& [detector, count] : states_[cell].counts) {
      auto& at = verdicts[detector];
      at.resize(curve.cell.size());
      at[level] = count.verdict();
    }
  }
  return verdicts;
}

std::set<int> TrialPlan::OpenCells() const {
  std::set<int> open;
  for (const Cell& cell : cells_) {
    if (!study_.parts[cell.part_index].envelope) open.insert(cell.index);
  }
  for (const LevelCurve& curve : curves_) {
    for (const size_t level : NextLevels(curve.cell.size(), VerdictsOf(curve))) {
      open.insert(curve.cell[level]);
    }
  }
  return open;
}

std::vector<TrialKey> TrialPlan::Next() const {
  std::vector<TrialKey> trials;
  for (const int cell : OpenCells()) {
    const auto index = static_cast<size_t>(cell);
    const Standing standing = StandingOf(index);
    if (standing.ended) continue;
    for (int trial = states_[index].complete; trial < standing.wanted; ++trial) {
      if (!states_[index].stored[static_cast<size_t>(trial)]) trials.push_back({cell, trial});
    }
  }
  return trials;
}

std::vector<EnvelopeCurve> TrialPlan::Envelopes() const {
  std::vector<EnvelopeCurve> envelopes;
  for (const LevelCurve& curve : curves_) {
    for (const auto& [detector, verdicts] : VerdictsOf(curve)) {
      EnvelopeCurve envelope{.curve = curve,
                             .detector = detector,
                             .holds = HoldingRanges(curve, verdicts),
                             .tested_levels = 0,
                             .trials = 0};
      for (size_t level = 0; level < verdicts.size(); ++level) {
        if (!verdicts[level]) continue;
        ++envelope.tested_levels;
        envelope.trials += states_[static_cast<size_t>(curve.cell[level])].complete;
      }
      envelopes.push_back(std::move(envelope));
    }
  }
  return envelopes;
}

}  // namespace fenestra
