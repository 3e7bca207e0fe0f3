#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/envelope_search.h"
#include "experiments/analysis/metric_tally.h"
#include "experiments/analysis/requirement_count.h"
#include "experiments/study/study.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// Which trials a study needs next, from the rows that it has: a pure function of study and rows,
/// so that any number of jobs, and a run that was killed and resumed, make the same trials.
///
/// A cell gets all its trials at once, unless its part stops by itself (StoppingRule) or looks for
/// an envelope (EnvelopeRule). Then it gets them in steps, up to each of its Looks, and after each
/// look none if its intervals are narrow enough, or if the requirement can no longer hold. An
/// envelope's cells are started only as the search comes to them (NextLevels).
class TrialPlan {
 public:
  /// Keeps references to both.
  TrialPlan(const Study& study, std::span<const Cell> cells);

  /// Rows must come by cell and trial, as ResultStore::ForEachRow shows them.
  void Add(const TrialRecord& row);

  /// Trials that are required but not yet stored, by cell and trial; empty when the study is done.
  std::vector<TrialKey> Next() const;

  /// The envelopes so far, one for each curve and detector.
  std::vector<EnvelopeCurve> Envelopes() const;

  /// How many trials the study makes at most.
  int64_t most_trials() const { return most_trials_; }

 private:
  struct CellState {
    std::vector<int> looks;
    size_t look = 0;     ///< Index of the next look.
    bool ended = false;  ///< Wants no more trials.
    int complete = 0;    ///< Number of trials that are stored without a gap, from the first one on.
    std::vector<bool> stored;
    std::map<std::string, MetricTally> tallies;      ///< Where a rule stops the cell.
    std::map<std::string, RequirementCount> counts;  ///< Where an envelope is looked for.
  };

  struct Standing {
    bool ended;
    int wanted;  ///< Trials that the cell shall have now.
  };
  Standing StandingOf(size_t cell) const;
  bool MayEnd(const Cell& cell, const CellState& state) const;
  std::set<int> OpenCells() const;
  CurveVerdicts VerdictsOf(const LevelCurve& curve) const;

  const Study& study_;
  std::span<const Cell> cells_;
  RowContext context_;
  std::vector<CellState> states_;
  std::vector<LevelCurve> curves_;
  int64_t most_trials_ = 0;
};

/// Whether every width that the rule asks for is met, by intervals with this confidence; a metric
/// that does not exist meets none.
bool IsNarrowEnough(const StoppingRule& rule, const MetricTally& tally, double confidence);

}  // namespace fenestra
