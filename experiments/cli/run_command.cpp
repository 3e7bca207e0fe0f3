#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "core/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/progress.h"
#include "experiments/prior_text.h"
#include "experiments/report.h"
#include "experiments/run_study.h"
#include "experiments/study_catalogue.h"
#include "experiments/study_reader.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

struct RunArguments {
  std::string study;
  std::filesystem::path out;
  int jobs = 0;  ///< 0: as many as there are processors.
  std::optional<uint64_t> seed;
  std::optional<int> trials;
};

void Run(const RunArguments& arguments) {
  YamlReader reader = YamlReader::FromFile(FindStudy(arguments.study));
  StudyRun run{.study = ReadStudy(reader, Detectors()),
               .study_text = reader.text(),
               .out = arguments.out,
               .jobs = arguments.jobs};
  if (arguments.seed) run.study.seed = *arguments.seed;
  if (arguments.trials) {
    for (StudyPart& part : run.study.parts) part.repetitions = *arguments.trials;
  }
  if (CountTrials(run.study) > kMostTrials) {
    throw InputError("--trials", fmt::format("makes {} trials in all; at most {} are run",
                                             CountTrials(run.study), kMostTrials));
  }
  if (run.out.empty()) run.out = std::filesystem::path("results") / run.study.name;
  if (run.jobs == 0) run.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));

  std::vector<CellSummary> summaries;
  {
    ProgressBar progress(static_cast<int>(CountTrials(run.study)));
    run.on_trial = [&progress] { progress.Advance(); };
    summaries = RunStudy(run);
  }
  fmt::print("{}", SummaryForTerminal(summaries));
  for (const auto& [what, prior] : PriorEntries(run.study)) fmt::print("{}: {}\n", what, prior);
  fmt::print("\nTables, rows and pictures are in {}\n", run.out.string());
}

}  // namespace

void AddRunCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("run", "Runs a study and prints its table");
  command->footer(
      "Example:\n"
      "  fenestra run paper --trials 50 --jobs 4 --out /tmp/paper\n"
      "STUDY is a name that 'fenestra list studies' shows, or a file.");
  const auto arguments = std::make_shared<RunArguments>();
  command->add_option("STUDY", arguments->study, "Name or file of a study")->required();
  command->add_option("--out", arguments->out, "Results folder; default: results/<study>");
  command->add_option("--jobs", arguments->jobs, "Trials at the same time; default: all processors")
      ->check(CLI::Range(1, 1024));
  command->add_option("--seed", arguments->seed, "Instead of the study's seed")
      ->check(CLI::Range(uint64_t{0}, uint64_t{INT64_MAX}));
  command->add_option("--trials", arguments->trials, "Trials of each cell, instead of the study's")
      ->check(CLI::Range(1, 1000000));
  command->callback([arguments, &exit_code] {
    Run(*arguments);
    exit_code = kDone;
  });
}

}  // namespace fenestra::cli
