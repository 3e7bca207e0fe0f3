#pragma once

#include <functional>
#include <span>
#include <vector>

#include "experiments/cell_bench.h"

namespace fenestra {

/// One trial of a study.
struct TrialKey {
  int cell = 0;   ///< Index into Cells(study).
  int trial = 0;  ///< Index in the cell, from 0.

  auto operator<=>(const TrialKey&) const = default;
};

/// All trials, cell by cell.
std::vector<TrialKey> AllTrials(std::span<const Cell> cells);

/// A trial that every detector of its cell has tried.
struct FinishedTrial {
  const CellBench& bench;
  const SimulatedTrial& simulated;
  const std::vector<Attempt>& attempts;

  TrialKey key() const { return {bench.cell().index, simulated.trial.index}; }
  std::vector<TrialRecord> Records() const;
};

struct RunOptions {
  int jobs = 1;  ///< Trials that run at the same time, at least 1.
  /// Whether detectors shall keep their pictures and clouds in this trial.
  std::function<bool(TrialKey)> keep_artifacts = [](TrialKey) { return false; };
};

/// Runs the trials, in about the order given, each on one thread. `finish` is called once for each,
/// from the thread that ran it and so from several threads at once. What a trial gives does not
/// depend on the number of jobs or on the order. The first exception that a trial or `finish`
/// throws ends the run and is thrown again here.
void RunTrials(const Study& study, std::span<const Cell> cells, std::span<const TrialKey> trials,
               const RunOptions& options, const std::function<void(const FinishedTrial&)>& finish);

}  // namespace fenestra
