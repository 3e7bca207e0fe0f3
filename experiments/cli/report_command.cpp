#include <filesystem>
#include <memory>

#include "experiments/cli/commands.h"
#include "experiments/cli/plugins.h"
#include "experiments/cli/print_result.h"
#include "experiments/run/result_files.h"

namespace fenestra::cli {
namespace {

struct ReportArguments {
  std::filesystem::path results;
  std::filesystem::path out;
  bool pictures = false;
  int jobs = 1;
  std::vector<std::filesystem::path> plugins;
};

void Report(const ReportArguments& arguments) {
  LoadPlugins(arguments.plugins);
  const std::filesystem::path file = StoreFile(arguments.results);
  const ResultStore store = ResultStore::OpenReadOnly(file);
  const std::filesystem::path out = arguments.out.empty() ? file.parent_path() : arguments.out;
  const Study study = StudyOf(store, file);
  const std::vector<Cell> cells = Cells(study);
  const std::vector<CellSummary> summaries = WriteResultFiles(store, study, cells, out);
  if (arguments.pictures) {
    WriteResultPictures(store, study, cells, out, arguments.jobs, MakerWith(arguments.plugins));
  }
  PrintResult(summaries, out);
}

}  // namespace

void AddReportCommand(Command program) {
  Command command =
      program.AddCommand("report", "Makes tables and files from a stored result again");
  command.Footer(
      "Example:\n"
      "  fenestra report results/paper --out /tmp/paper --pictures\n"
      "Works on results.sqlite alone, also while a run is writing it.");
  const auto arguments = std::make_shared<ReportArguments>();
  command.AddOption("RESULTS", arguments->results, "Results folder or its results.sqlite")
      .Required();
  command.AddOption("--out", arguments->out, "Folder for the files; default: where the rows are");
  command.AddFlag("--pictures", arguments->pictures,
                  "Runs the first trial of each cell again for its pictures");
  command.AddOption("--jobs", arguments->jobs, "Trials at the same time, for the pictures")
      .Within(1, 1024);
  AddPluginOption(command, arguments->plugins);
  command.Action([arguments] {
    Report(*arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli
