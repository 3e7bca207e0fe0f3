#include <fmt/format.h>

#include <filesystem>

#include "core/input_error.h"
#include "experiments/cell_bench.h"
#include "experiments/cli/commands.h"
#include "experiments/study_catalogue.h"
#include "experiments/study_reader.h"
#include "experiments/trial_files.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

struct RenderArguments {
  std::string study;
  int cell = 0;
  int trial = 0;
  std::filesystem::path out;
};

void Render(const RenderArguments& arguments) {
  const Study study = ReadStudyFile(FindStudy(arguments.study), Detectors());
  const std::vector<Cell> cells = Cells(study);
  if (arguments.cell < 0 || arguments.cell >= static_cast<int>(cells.size())) {
    throw InputError("--cell", fmt::format("{} is not a cell of '{}': 0 to {}", arguments.cell,
                                           study.name, cells.size() - 1));
  }
  if (arguments.trial < 0) {
    throw InputError("--trial", fmt::format("must not be negative, but is {}", arguments.trial));
  }
  const CellBench bench(study, cells[static_cast<size_t>(arguments.cell)]);
  WriteTrialFiles(arguments.out, bench, bench.Simulate(arguments.trial));
  fmt::print("Cell {} trial {} of '{}' is in {}\n", arguments.cell, arguments.trial, study.name,
             arguments.out.string());
}

}  // namespace

void AddRenderCommand(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("render", "Writes the observation and the truth of one trial");
  command->footer(
      "Example:\n"
      "  fenestra render paper --cell 2 --trial 5 --out /tmp/trial\n"
      "DIR gets what a detector sees (PNG, YAML) and, in DIR/truth, what it must not see (JSON, "
      "EXR, "
      "PCD).");
  const auto arguments = std::make_shared<RenderArguments>();
  command->add_option("STUDY", arguments->study, "Name or file of a study")->required();
  command->add_option("--cell", arguments->cell, "Index of the cell")->capture_default_str();
  command->add_option("--trial", arguments->trial, "Index of the trial")->capture_default_str();
  command->add_option("--out", arguments->out, "Folder for the files")->required();
  command->callback([arguments, &exit_code] {
    Render(*arguments);
    exit_code = kDone;
  });
}

}  // namespace fenestra::cli
