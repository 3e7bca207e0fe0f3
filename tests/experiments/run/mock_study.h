#pragma once

#include <filesystem>
#include <string>

#include "core/io/input_error.h"
#include "experiments/report/report.h"
#include "experiments/run/run_study.h"
#include "experiments/study_file/study_reader.h"
#include "tests/experiments/run/mock_runner.h"
#include "vision/detector_registry.h"

namespace fenestra::testing {

/// Three cells before a stereo rig.
inline Study MockStudy(int repetitions, int seed = 3) {
  const std::string text = "name: mock\nseed: " + std::to_string(seed) +
                           "\nrepetitions: " + std::to_string(repetitions) +
                           "\nsensors: [stereo]\nfactors:\n  distance_m: [2, 3, 4]\n"
                           "  yaw_deg: {uniform: [-2, 2]}\n";
  return ReadStudy(YamlReader::FromText(text, "mock.yaml"), Detectors());
}

/// On mock runners, with two jobs.
inline StudyRun MockRun(const Study& study, const std::filesystem::path& out, Shard shard = {}) {
  return {.study = study,
          .study_text = "",
          .out = out,
          .jobs = 2,
          .shard = shard,
          .pictures = false,
          .make_runner = MockRunner::Make};
}

/// All rows, to the last bit: the times of mock runners are constant.
inline std::string RowsIn(const std::filesystem::path& out) {
  return TrialsCsv(ResultStore::OpenReadOnly(out / "results.sqlite").Rows());
}

/// What the InputError that `run` throws says.
inline std::string Refusal(const auto& run) {
  try {
    run();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace fenestra::testing
