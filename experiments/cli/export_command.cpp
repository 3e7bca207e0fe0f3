#include <fmt/format.h>

#include <filesystem>

#include "core/io/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/sampling/trial_sampler.h"
#include "experiments/study_file/study_catalogue.h"
#include "experiments/study_file/study_reader.h"
#include "experiments/trial_files/scene_views.h"
#include "scenes/gltf/writer/gltf_writer.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

struct ExportArguments {
  std::string study;
  std::vector<std::filesystem::path> plugins;
  int cell = 0;
  int trial = 0;
  std::filesystem::path out;
};

void Export(const ExportArguments& arguments) {
  LoadPlugins(arguments.plugins);
  const Study study = ReadStudyFile(FindStudy(arguments.study), Detectors());
  if (arguments.trial < 0) {
    throw InputError("--trial", fmt::format("must not be negative, but is {}", arguments.trial));
  }
  const Trial trial = SampleTrial(study, CellOf(study, arguments.cell), arguments.trial);
  WriteGltf(arguments.out, TrialScene(trial.settings));
  fmt::print("The scene of cell {} trial {} of '{}' is in {}\n", arguments.cell, arguments.trial,
             study.name, arguments.out.string());
}

}  // namespace

void AddExportCommand(Command program) {
  Command command = program.AddCommand(
      "export", "Writes the scene of one trial as glTF, with the cameras and the target in it");
  command.Footer(
      "Example:\n"
      "  fenestra export facade --cell 0 --out facade.glb\n"
      "The file opens in any glTF viewer, and in `fenestra render` with the same truth.");
  const auto arguments = std::make_shared<ExportArguments>();
  command.AddOption("STUDY", arguments->study, "Name or file of a study").Required();
  command.AddOption("--cell", arguments->cell, "Index of the study's cell").ShowDefault();
  command.AddOption("--trial", arguments->trial, "Index of the trial").ShowDefault();
  command.AddOption("--out", arguments->out, "A .gltf or .glb file").Required();
  AddPluginOption(command, arguments->plugins);
  command.Action([arguments] {
    Export(*arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli
