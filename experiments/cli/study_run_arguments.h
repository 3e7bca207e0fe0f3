#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "experiments/run_study.h"

namespace fenestra::cli {

/// What a user may say of any run of a study, whichever command starts it.
struct StudyRunArguments {
  std::filesystem::path out = {};
  int jobs = 0;  ///< 0: as many as there are processors.
  std::optional<uint64_t> seed = {};
  std::optional<int> trials = {};
  std::vector<std::filesystem::path> plugins = {};
};

/// --seed and --trials, which change the study; --plugin.
void AddStudyOptions(CLI::App& command, StudyRunArguments& arguments);
/// --seed alone.
CLI::Option* AddSeedOption(CLI::App& command, std::optional<uint64_t>& seed);
/// --jobs, which stays 0 where it is not given.
CLI::Option* AddJobsOption(CLI::App& command, int& jobs);
/// As many as there are processors for 0.
int JobsOrAll(int jobs);
/// All of these and --out. Returns all that make no sense without a run.
std::vector<CLI::Option*> AddStudyRunOptions(CLI::App& command, StudyRunArguments& arguments);

/// Loads the plugins and reads the study. Throws InputError.
StudyRun MakeStudyRun(const std::filesystem::path& study_file, const StudyRunArguments& arguments);

/// Shows the progress on standard error; Ctrl-C ends the run with what is done stored.
StudyResult RunWithProgress(StudyRun run);

}  // namespace fenestra::cli
