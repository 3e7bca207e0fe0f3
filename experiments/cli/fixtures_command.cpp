#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "core/io/input_error.h"
#include "core/io/input_file.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/cli/progress.h"
#include "experiments/cli/study_run_arguments.h"
#include "experiments/fixtures/fixture_order.h"
#include "experiments/fixtures/fixtures.h"
#include "experiments/fixtures/manifest.h"
#include "experiments/fixtures/staging_folder.h"
#include "experiments/output/number_format.h"
#include "experiments/run/result_files.h"
#include "experiments/study_file/study_catalogue.h"
#include "experiments/study_file/study_reader.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

namespace fs = std::filesystem;

struct FixtureArguments {
  std::string study;
  fs::path out;
  TrialSelection selection;
  std::vector<std::string> formats = {"bundle"};
  std::optional<uint64_t> seed;
  int jobs = 0;  ///< 0: as many as there are processors.
  bool dry_run = false;
  fs::path verify;
  std::vector<fs::path> plugins;
};

bool IsResult(const fs::path& path) {
  std::error_code error;
  return LowerExtension(path) == ".sqlite" ||
         fs::is_regular_file(path / ResultStore::kFileName, error);
}

void ReadStudyInto(FixtureOrder& order, const std::string& study) {
  if (IsResult(study)) {
    const ResultStore store = ResultStore::OpenReadOnly(StoreFile(study));
    order.study = StudyOf(store, study);
    order.study_text = store.Metadata().at("study_text");
    return;
  }
  YamlReader reader = YamlReader::FromFile(FindStudy(study));
  order.study = ReadStudy(reader, Detectors());
  order.study_text = reader.text();
}

std::set<FixtureFormat> FormatsOf(const std::vector<std::string>& names) {
  std::set<FixtureFormat> formats;
  for (const FixtureFormat format : kAllFixtureFormats) {
    for (const std::string& name : names) {
      if (name == "all" || name == ToString(format)) formats.insert(format);
    }
  }
  return formats;
}

void PrintTrials(const FixtureOrder& order) {
  for (const TrialKey& key : order.trials) {
    const Cell& cell = order.cells[static_cast<size_t>(key.cell)];
    fmt::print("{}/{} {} {}{}{}\n", key.cell, key.trial, cell.part, ToString(cell.sensor),
               cell.levels.empty() ? "" : " ", LevelsText(cell.levels));
  }
}

FixtureOrder OrderOf(const FixtureArguments& arguments) {
  if (arguments.study.empty()) throw InputError("STUDY", "is missing; or give --verify DIR");
  if (arguments.out.empty() && !arguments.dry_run) {
    throw InputError("--out", "is missing: the folder for the fixtures");
  }
  if (!arguments.out.empty()) CheckNewFolder(arguments.out);
  LoadPlugins(arguments.plugins);
  FixtureOrder order;
  ReadStudyInto(order, arguments.study);
  if (arguments.seed) order.study.seed = *arguments.seed;
  order.cells = Cells(order.study);
  order.trials = SelectTrials(order.study, order.cells, arguments.selection);
  const auto& names = arguments.formats;
  const bool all = std::find(names.begin(), names.end(), "all") != names.end();
  order.formats = UsefulFormats(FormatsOf(names), order.cells, order.trials, all);
  order.out = arguments.out;
  order.jobs = JobsOrAll(arguments.jobs);
  return order;
}

int MakeFixtures(const FixtureArguments& arguments) {
  FixtureOrder order = OrderOf(arguments);
  const std::string what = fmt::format("{} trial{} of '{}'", order.trials.size(),
                                       order.trials.size() == 1 ? "" : "s", order.study.name);
  const std::string estimate = Bytes(static_cast<double>(EstimatedBytes(order)));
  if (arguments.dry_run) {
    PrintTrials(order);
    fmt::print("{}, about {}; nothing was written\n", what, estimate);
    return kDone;
  }
  Tell(fmt::format("{}, about {}", what, estimate));
  bool whole = false;
  {
    const InterruptWatch watch;
    Progress progress(Progress::ForStandardError());
    progress.Start({.trials = static_cast<int64_t>(order.trials.size()), .tallies = {}});
    order.stop = [&watch] { return watch.requested(); };
    order.on_trial = [&progress] { progress.Add({}); };
    whole = WriteFixtures(order);
  }
  if (!whole) {
    Tell(fmt::format("fenestra: interrupted; nothing was left in {}", order.out.string()));
    return kFailure;
  }
  fmt::print("{} are in {}, {}\n", what, order.out.string(),
             Bytes(static_cast<double>(FolderSize(order.out))));
  return kDone;
}

int Verify(const FixtureArguments& arguments) {
  if (!arguments.study.empty() || !arguments.out.empty()) {
    throw InputError("--verify", "checks fixtures that are there; it takes no study and no --out");
  }
  const size_t files = VerifyChecksums(arguments.verify);
  fmt::print("{} files in {} are those that were written\n", files, arguments.verify.string());
  return kDone;
}

}  // namespace

void AddFixturesCommand(Command program) {
  Command command = program.AddCommand(
      "fixtures", "Writes trials as files for the tests of other programs, with their truth");
  command.Footer(
      "Examples:\n"
      "  fenestra fixtures paper --out fixtures                   the first trial of each cell\n"
      "  fenestra fixtures paper --trials 0-4 --where 'sensor = rgbd and distance_m <= 2' "
      "--format bundle,tum --out fixtures\n"
      "  fenestra fixtures results/paper --trials 7/3 --out fixtures\n"
      "  fenestra fixtures --verify fixtures\n"
      "The same command makes the same bytes. docs/fixtures.md describes the files.");
  const auto arguments = std::make_shared<FixtureArguments>();
  command.AddOption("STUDY|RESULTS", arguments->study,
                    "Name or file of a study, or the results of one");
  command.AddOption("--out", arguments->out, "Folder for the files, new or empty");
  command
      .AddOption("--trials", arguments->selection.trials,
                 "Trials of each cell (0-4), or CELL/TRIALS (7/3,8/0-2)")
      .ShowDefault();
  command.AddOption("--cells", arguments->selection.cells, "Only these cells (0,3-5)");
  command.AddOption("--where", arguments->selection.where,
                    "Only trials with these values, as in the where of a limit");
  command
      .AddOption("--format", arguments->formats,
                 "bundle, tum (RGB-D), euroc (stereo), several with commas, or all")
      .Delimiter(',')
      .OneOf({"bundle", "tum", "euroc", "all"})
      .ShowDefault();
  AddPluginOption(command, arguments->plugins);
  AddSeedOption(command, arguments->seed);
  AddJobsOption(command, arguments->jobs);
  command.AddFlag("--dry-run", arguments->dry_run, "Show the trials and the size, write nothing");
  command.AddOption("--verify", arguments->verify,
                    "Check that this folder's files are those that were written");
  command.Action([arguments] {
    return arguments->verify.empty() ? MakeFixtures(*arguments) : Verify(*arguments);
  });
}

}  // namespace fenestra::cli
