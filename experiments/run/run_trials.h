#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "experiments/trial/detector_maker.h"
#include "experiments/trial/trial_runner.h"

namespace fenestra {

/// All trials, cell by cell.
std::vector<TrialKey> AllTrials(std::span<const Cell> cells);

/// Makes the runner of a cell. Called when the cell's first trial starts, from the thread that runs
/// it; the runner is dropped after the cell's last trial, so that memory holds few scenes at a
/// time.
using RunnerMaker = std::function<std::shared_ptr<const TrialRunner>(const Study&, const Cell&)>;

/// How trials are run; none of it changes what they give.
struct RunOptions {
  int jobs = 1;  ///< Trials that run at the same time, at least 1.
  /// Whether detectors shall keep their pictures and clouds in this trial.
  std::function<bool(TrialKey)> keep_artifacts = [](TrialKey) { return false; };
  /// Asked before each trial, by several threads at once; true ends the run when the trials that
  /// run have finished.
  std::function<bool()> stop = [] { return false; };
  std::shared_ptr<DetectorMaker> detectors = std::make_shared<DetectorMaker>();
  RunnerMaker make_runner = {};  ///< Empty: CellRunner, whose detectors `detectors` makes.
};

/// Runs the trials, in about the order given, each on one thread and at most once. Every trial must
/// be one of `cells`. `finish` is called once for each, from the thread that ran it and so from
/// several threads at once. What a trial gives does not depend on the number of jobs or on the
/// order. The first exception that a trial or `finish` throws ends the run and is thrown again
/// here.
void RunTrials(const Study& study, std::span<const Cell> cells, std::span<const TrialKey> trials,
               const RunOptions& options, const std::function<void(const FinishedTrial&)>& finish);

}  // namespace fenestra
