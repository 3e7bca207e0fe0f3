#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "core/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/interrupt.h"
#include "experiments/cli/print_result.h"
#include "experiments/cli/progress.h"
#include "experiments/run_study.h"
#include "experiments/study_catalogue.h"
#include "experiments/study_reader.h"
#include "experiments/versions.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

struct RunArguments {
  std::string study;
  std::filesystem::path out;
  int jobs = 0;  ///< 0: as many as there are processors.
  std::optional<uint64_t> seed;
  std::optional<int> trials;
  std::string shard = "1/1";
  bool restart = false;
  bool no_pictures = false;
};

StudyRun StudyRunOf(const RunArguments& arguments) {
  YamlReader reader = YamlReader::FromFile(FindStudy(arguments.study));
  StudyRun run{.study = ReadStudy(reader, Detectors()),
               .study_text = reader.text(),
               .out = arguments.out,
               .jobs = arguments.jobs,
               .shard = Shard::Parse(arguments.shard),
               .restart = arguments.restart,
               .pictures = !arguments.no_pictures,
               .command = CommandLine()};
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
  return run;
}

int Run(const RunArguments& arguments) {
  StudyRun run = StudyRunOf(arguments);
  StudyResult result;
  {
    const InterruptWatch watch;
    Progress progress(Progress::ForStandardError());
    run.on_start = [&progress](const RunStart& start) { progress.Start(start); };
    run.on_stored = [&progress](std::span<const TrialRecord> rows) { progress.Add(rows); };
    run.stop = [&watch] { return watch.requested(); };
    result = RunStudy(run);
  }
  if (!result.complete()) {
    fmt::print(stderr,
               "fenestra: interrupted; {} of {} trials are stored in {}. The same command goes on "
               "from there.\n",
               result.stored, result.trials, run.out.string());
    return kFailure;
  }
  if (result.stored_before == result.trials) {
    fmt::print("The result in {} is complete; nothing was run.\n\n", run.out.string());
  }
  PrintResult(result.summaries, run.out);
  return kDone;
}

}  // namespace

void AddRunCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("run", "Runs a study and prints its table");
  command->footer(
      "Example:\n"
      "  fenestra run paper --trials 50 --jobs 4 --out /tmp/paper\n"
      "STUDY is a name that 'fenestra list studies' shows, or a file.\n"
      "A run that was interrupted or killed goes on when it is called again. Ctrl-C ends it with "
      "all\n"
      "finished trials stored and exit code 3.");
  const auto arguments = std::make_shared<RunArguments>();
  command->add_option("STUDY", arguments->study, "Name or file of a study")->required();
  command->add_option("--out", arguments->out, "Results folder; default: results/<study>");
  command->add_option("--jobs", arguments->jobs, "Trials at the same time; default: all processors")
      ->check(CLI::Range(1, 1024));
  command->add_option("--seed", arguments->seed, "Instead of the study's seed")
      ->check(CLI::Range(uint64_t{0}, uint64_t{INT64_MAX}));
  command->add_option("--trials", arguments->trials, "Trials of each cell, instead of the study's")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--shard", arguments->shard,
                      "I/N: only the I-th of N shares of the trials, I from 1; see 'merge'");
  command->add_flag("--restart", arguments->restart, "Replaces the result that is there");
  command->add_flag("--no-pictures", arguments->no_pictures,
                    "Without pictures of each cell's first trial");
  command->callback([arguments, &exit_code] { exit_code = Run(*arguments); });
}

}  // namespace fenestra::cli
