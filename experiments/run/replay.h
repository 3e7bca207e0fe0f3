#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "experiments/trial/detector_maker.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// One recorded trial under one detector, and what running it again gave.
struct ReplayedRow {
  TrialRecord recorded;
  TrialRecord repeated;
  /// The differences apart from the stage times, for people; empty if every bit is the same.
  std::vector<std::string> differences;
};

/// Runs a recorded trial again from the store alone. `results` is a results folder or its
/// results.sqlite. With `out`, writes every picture (WritePictures) and the files of the trial
/// (WriteTrialFiles). Throws InputError if the store has no such trial.
std::vector<ReplayedRow> Replay(
    const std::filesystem::path& results, int cell, int trial,
    const std::filesystem::path& out = {},
    std::shared_ptr<DetectorMaker> detectors = std::make_shared<DetectorMaker>());

}  // namespace fenestra
