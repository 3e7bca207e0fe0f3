#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/report/bound_table.h"
#include "experiments/study_file/study_catalogue.h"
#include "experiments/study_file/study_reader.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

struct BoundArguments {
  std::string study;
  std::vector<std::filesystem::path> plugins;
  std::optional<int> cell;
  int trials = 5;
};

constexpr char kLegend[] =
    "Cramér and Rao's bounds on the centroid's error [mm], √ of the mean over n trials in view: "
    "in\n"
    "depth (z) and in space (3D). told: with the calibration that stereo detectors are told, "
    "whose\n"
    "error is unknown; for RGB-D with a wall whose face stands before the frame by 10 cm more or "
    "less.\n"
    "geom: with the true calibration; for RGB-D that distance is known. size: as told, and the\n"
    "frame's size is known. both: geom and the size. —: no bound. See docs/theory.md.\n";

void PrintBounds(const BoundArguments& arguments) {
  LoadPlugins(arguments.plugins);
  const Study study = ReadStudyFile(FindStudy(arguments.study), Detectors());
  std::vector<Cell> cells;
  if (arguments.cell) {
    cells.push_back(CellOf(study, *arguments.cell));
  } else {
    cells = Cells(study);
  }
  std::vector<CellBounds> bounds;
  for (const Cell& cell : cells) bounds.push_back(BoundsOfCell(study, cell, arguments.trials));
  fmt::print("{}\n{}", BoundTable(bounds), kLegend);
}

}  // namespace

void AddBoundCommand(Command program) {
  Command command =
      program.AddCommand("bound", "Prints how exactly a study's windows could be found at best");
  command.Footer(
      "Example:\n"
      "  fenestra bound paper --trials 3\n"
      "Renders the first trials of each cell; no detector sees them.");
  const auto arguments = std::make_shared<BoundArguments>();
  command.AddOption("STUDY", arguments->study, "Name or file of a study").Required();
  command.AddOption("--cell", arguments->cell, "Only this cell, by its index");
  command.AddOption("--trials", arguments->trials, "Of each cell").Within(1, 100000).ShowDefault();
  AddPluginOption(command, arguments->plugins);
  command.Action([arguments] {
    PrintBounds(*arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli
