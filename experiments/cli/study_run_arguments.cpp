#include "experiments/cli/study_run_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "core/io/input_error.h"
#include "core/system/program.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/cli/progress.h"
#include "experiments/report/provenance.h"
#include "experiments/report/report.h"
#include "experiments/run/stored_study.h"
#include "experiments/study_file/study_reader.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

void CheckSize(const Study& study) {
  if (CountTrials(study) <= kMostTrials) return;
  throw InputError("--trials", fmt::format("makes {} trials in all; at most {} are run",
                                           CountTrials(study), kMostTrials));
}

}  // namespace

void AddStudyOptions(Command command, StudyRunArguments& arguments) {
  AddSeedOption(command, arguments.seed);
  command.AddOption("--trials", arguments.trials, "Trials of each cell, instead of the study's")
      .Within(1, 1000000);
  AddPluginOption(command, arguments.plugins);
}

Option AddSeedOption(Command command, std::optional<uint64_t>& seed) {
  return command.AddOption("--seed", seed, "Instead of the study's seed")
      .Within(uint64_t{0}, uint64_t{INT64_MAX});
}

Option AddJobsOption(Command command, int& jobs) {
  return command.AddOption("--jobs", jobs, "Trials at the same time; default: all processors")
      .Within(1, 1024);
}

int JobsOrAll(int jobs) {
  return jobs > 0 ? jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

std::vector<Option> AddStudyRunOptions(Command command, StudyRunArguments& arguments) {
  Option out =
      command.AddOption("--out", arguments.out, "Results folder; default: results/<study>");
  Option jobs = AddJobsOption(command, arguments.jobs);
  AddStudyOptions(command, arguments);
  return {out, jobs, command.FindOption("--seed"), command.FindOption("--trials")};
}

StudyRun MakeStudyRun(const std::filesystem::path& study_file, const StudyRunArguments& arguments) {
  LoadPlugins(arguments.plugins);
  YamlReader reader = YamlReader::FromFile(study_file);
  StudyRun run{.study = ReadStudy(reader, Detectors()),
               .study_text = reader.text(),
               .out = arguments.out,
               .jobs = JobsOrAll(arguments.jobs),
               .command = CommandLine(),
               .detectors = MakerWith(arguments.plugins)};
  if (arguments.seed) run.study.seed = *arguments.seed;
  if (arguments.trials) {
    for (StudyPart& part : run.study.parts) part.repetitions = *arguments.trials;
  }
  CheckSize(run.study);
  if (run.out.empty()) run.out = std::filesystem::path("results") / run.study.name;
  return run;
}

StudyResult RunWithProgress(StudyRun run) {
  const InterruptWatch watch;
  Progress progress(Progress::ForStandardError());
  run.on_start = [&progress](const RunStart& start) { progress.Start(start); };
  run.on_stored = [&progress](std::span<const TrialRecord> rows) { progress.Add(rows); };
  run.stop = [&watch] { return watch.requested(); };
  return RunStudy(run);
}

void NoteMissingTrials(const ResultStore& store, const std::filesystem::path& file) {
  const std::string part = PartStored(store, file);
  if (!part.empty()) Tell(fmt::format("note: {} holds {}", file.string(), part));
}

void PrintResult(const std::vector<CellSummary>& summaries, const std::filesystem::path& folder) {
  fmt::print("{}", SummaryForTerminal(summaries));
  const Study study = ReadStudyFile(folder / "study.yaml", Detectors());
  for (const auto& [what, prior] : PriorEntries(study)) fmt::print("{}: {}\n", what, prior);
  fmt::print("\nTables and rows are in {}\n", folder.empty() ? "." : folder.string());
}

}  // namespace fenestra::cli
