#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "experiments/analysis/cell_summary.h"
#include "experiments/cli/command_line.h"
#include "experiments/run/run_study.h"
#include "experiments/store/store.h"

namespace fenestra::cli {

/// The options of any run of a study, whichever command starts it.
struct StudyRunArguments {
  std::filesystem::path out = {};
  int jobs = 0;  ///< 0: as many as there are processors.
  std::optional<uint64_t> seed = {};
  std::optional<int> trials = {};
  std::vector<std::filesystem::path> plugins = {};
};

/// --seed and --trials, which change the study; --plugin.
void AddStudyOptions(Command command, StudyRunArguments& arguments);
/// --seed alone.
Option AddSeedOption(Command command, std::optional<uint64_t>& seed);
/// --jobs, which stays 0 where it is not given.
Option AddJobsOption(Command command, int& jobs);
/// As many as there are processors for 0.
int JobsOrAll(int jobs);
/// All of these and --out. Returns those that have no effect without a run.
std::vector<Option> AddStudyRunOptions(Command command, StudyRunArguments& arguments);

/// Loads the plugins and reads the study. Throws InputError.
StudyRun MakeStudyRun(const std::filesystem::path& study_file, const StudyRunArguments& arguments);

/// Shows the progress on standard error; Ctrl-C ends the run with what is done stored.
StudyResult RunWithProgress(StudyRun run);

/// Prints the tables of a result, the prior knowledge of its detectors, and where its files are.
/// Says on standard error if the store lacks trials of its study.
void NoteMissingTrials(const ResultStore& store, const std::filesystem::path& file);

void PrintResult(const std::vector<CellSummary>& summaries, const std::filesystem::path& folder);

}  // namespace fenestra::cli
