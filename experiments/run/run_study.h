#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/cell_summary.h"
#include "experiments/run/run_trials.h"
#include "experiments/run/shards.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"
#include "experiments/trial/detector_maker.h"

namespace fenestra {

/// The state of a result when a run starts.
struct RunStart {
  int64_t trials = 0;                  ///< Trials of the study, or of its shard.
  int64_t stored = 0;                  ///< Those of them that earlier runs have stored.
  std::vector<DetectorTally> tallies;  ///< Hits in the stored ones.
};

/// A run of a study, or of a shard of it, into a results folder (see result_files.h).
///
/// A folder that holds part of the same result is continued: trials that are stored are not run
/// again, and the rows are those of an undisturbed run. The same is a result of the same study,
/// seed, shard, program, libraries and instruction set (RunIdentity); any other is refused with an
/// InputError that says what differs, unless `restart` is set, which replaces a sound result and
/// nothing else. Files that a person put into the folder stay.
struct StudyRun {
  Study study;
  std::string study_text;  ///< As written by the user.
  std::filesystem::path out;
  int jobs = 1;
  Shard shard = {};
  bool restart = false;
  bool pictures = true;
  std::string command = "";  ///< As a person would repeat it.
  /// See TrialWriter.
  std::chrono::milliseconds store_interval{500};

  std::function<void(const RunStart&)> on_start = [](const RunStart&) {};
  /// Called from one thread with the rows of each trial when a kill can no longer lose them.
  std::function<void(std::span<const TrialRecord>)> on_stored = [](auto) {};
  /// See RunOptions.
  std::function<bool()> stop = [] { return false; };
  std::shared_ptr<DetectorMaker> detectors = std::make_shared<DetectorMaker>();
  RunnerMaker make_runner = {};  ///< See RunOptions.
};

struct StudyResult {
  int64_t trials = 0;  ///< Trials of the study, or of its shard.
  int64_t stored_before = 0;
  int64_t stored = 0;
  /// Empty if the run was stopped before its end.
  std::vector<CellSummary> summaries;

  bool complete() const { return stored == trials; }
};

/// Throws InputError before anything is written if a detector's program cannot be started.
StudyResult RunStudy(const StudyRun& run);

}  // namespace fenestra
