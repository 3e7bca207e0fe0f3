#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "experiments/analysis/paired_ratio.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/cli/study_run_arguments.h"
#include "experiments/report/paired_ratio_report.h"
#include "experiments/run/result_files.h"
#include "experiments/store/store.h"

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
  const OutputPath out = ResultsFolder(arguments.out.empty() ? file.parent_path() : arguments.out);
  NoteMissingTrials(store, file);
  const Study study = StudyOf(store, file);
  const std::vector<Cell> cells = Cells(study);
  const std::vector<CellSummary> summaries = WriteResultFiles(store, study, cells, out);
  if (arguments.pictures) {
    WriteResultPictures(store, study, cells, out, arguments.jobs, MakerWith(arguments.plugins));
  }
  PrintResult(summaries, out.path());
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

void AddRatiosCommand(Command program) {
  Command command = program.AddCommand(
      "ratios", "Compares the levels of one factor in a study's results, trial by trial");
  command.Footer(
      "Example:\n"
      "  fenestra ratios results/depth_models --factor rgbd_depth_model\n"
      "RMSE and P95 of the centroid error under each level over those under the first one, with 90 "
      "%\n"
      "bootstrap intervals: trials of one index have the same poses under all levels.");
  const auto results = std::make_shared<std::filesystem::path>();
  const auto factor = std::make_shared<std::string>();
  command.AddOption("RESULTS", *results, "Results folder or its results.sqlite").Required();
  command.AddOption("--factor", *factor, "A factor with levels").Required();
  command.Action([results, factor] {
    const std::filesystem::path file = StoreFile(*results);
    const ResultStore store = ResultStore::OpenReadOnly(file);
    NoteMissingTrials(store, file);
    const std::vector<TrialRecord> rows = store.Rows();
    const std::vector<PairedCells> pairs = PairsBy(rows, *factor, ContextOf(store, file));
    fmt::print("{}", PairedRatioTable(pairs, *factor, RandomStream(1)));
    return kDone;
  });
}

}  // namespace fenestra::cli
