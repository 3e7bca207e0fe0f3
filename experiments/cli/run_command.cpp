#include <fmt/format.h>

#include <memory>
#include <string>

#include "experiments/cli/commands.h"
#include "experiments/cli/study_run_arguments.h"
#include "experiments/study_file/study_catalogue.h"

namespace fenestra::cli {
namespace {

struct RunArguments {
  std::string study;
  StudyRunArguments run;
  std::string shard = "1/1";
  bool restart = false;
  bool no_pictures = false;
};

int Run(const RunArguments& arguments) {
  StudyRun run = MakeStudyRun(FindStudy(arguments.study), arguments.run);
  run.shard = Shard::Parse(arguments.shard);
  run.restart = arguments.restart;
  run.pictures = !arguments.no_pictures;
  const StudyResult result = RunWithProgress(run);
  if (!result.complete()) {
    Tell(fmt::format(
        "fenestra: interrupted; {} of {} trials are stored in {}. The same command goes on from "
        "there.",
        result.stored, result.trials, run.out.string()));
    return kFailure;
  }
  if (result.stored_before == result.trials) {
    fmt::print("The result in {} is complete; nothing was run.\n\n", run.out.string());
  }
  PrintResult(result.summaries, run.out);
  return kDone;
}

}  // namespace

void AddRunCommand(Command program) {
  Command command = program.AddCommand("run", "Runs a study and prints its table");
  command.Footer(
      "Example:\n"
      "  fenestra run paper --trials 50 --jobs 4 --out /tmp/paper\n"
      "STUDY is a name that 'fenestra list studies' shows, or a file.\n"
      "A run that was interrupted or killed goes on when it is called again. Ctrl-C ends it with "
      "all\n"
      "finished trials stored and exit code 3.");
  const auto arguments = std::make_shared<RunArguments>();
  command.AddOption("STUDY", arguments->study, "Name or file of a study").Required();
  AddStudyRunOptions(command, arguments->run);
  command.AddOption("--shard", arguments->shard,
                    "I/N: only the I-th of N shares of the trials, I from 1; see 'merge'");
  command.AddFlag("--restart", arguments->restart, "Replaces the result that is there");
  command.AddFlag("--no-pictures", arguments->no_pictures,
                  "Without pictures of each cell's first trial");
  command.Action([arguments] { return Run(*arguments); });
}

}  // namespace fenestra::cli
