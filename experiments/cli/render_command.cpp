#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>

#include "core/geometry/pose.h"
#include "core/io/input_error.h"
#include "core/io/input_file.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/sequence/sequence_writer.h"
#include "experiments/study_file/study_catalogue.h"
#include "experiments/study_file/study_reader.h"
#include "experiments/trial/cell_runner.h"
#include "experiments/trial_files/scene_views.h"
#include "experiments/trial_files/trial_files.h"
#include "scenes/gltf/reader/gltf_reader.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

struct RenderArguments {
  std::string what;
  int cell = 0;
  int trial = 0;
  std::optional<SensorKind> sequence;  ///< All trials of this sensor.
  std::vector<std::filesystem::path> plugins;
  std::filesystem::path out;

  std::optional<std::string> target;
  SceneViewOptions view;
  double memory_gb = 1.0;
  Sky::Model sky_model = Sky::Model::kUniform;
  double sky_lx = 10e3;
  std::optional<double> sun_lx;
  std::optional<double> sun_azimuth_deg;
  std::optional<double> sun_elevation_deg;
};

bool IsSceneFile(const std::filesystem::path& file) {
  const std::string extension = LowerExtension(file);
  return extension == ".gltf" || extension == ".glb";
}

void RenderTrial(const RenderArguments& arguments) {
  LoadPlugins(arguments.plugins);
  const OutputPath out = OutputPath::Folder(arguments.out);
  const Study study = ReadStudyFile(FindStudy(arguments.what), Detectors());
  if (arguments.sequence) {
    const int frames = WriteSequence(out, study, *arguments.sequence);
    fmt::print("{} trials of '{}' are in {}\n", frames, study.name,
               (arguments.out / "sequence.yaml").string());
    return;
  }
  const Cell cell = CellOf(study, arguments.cell);
  if (arguments.trial < 0) {
    throw InputError("--trial", fmt::format("must not be negative, but is {}", arguments.trial));
  }
  const CellRunner runner(study, cell);
  WriteTrialFiles(out, runner, runner.Simulate(arguments.trial));
  fmt::print("Cell {} trial {} of '{}' is in {}\n", arguments.cell, arguments.trial, study.name,
             arguments.out.string());
}

Lighting LightingFor(const RenderArguments& arguments, const GltfScene& world) {
  Lighting lighting;
  if (world.sun) lighting.sun = *world.sun;
  lighting.sky.model = arguments.sky_model;
  lighting.sky.illuminance_lx = arguments.sky_lx;
  if (arguments.sun_lx) lighting.sun.illuminance_lx = *arguments.sun_lx;
  if (arguments.sun_azimuth_deg) lighting.sun.azimuth_rad = *arguments.sun_azimuth_deg * kDegree;
  if (arguments.sun_elevation_deg) {
    lighting.sun.elevation_rad = *arguments.sun_elevation_deg * kDegree;
  }
  return lighting;
}

void RenderScene(RenderArguments arguments) {
  if (!(arguments.memory_gb > 0.0 && arguments.memory_gb <= 1e6)) {
    throw InputError("--memory-gb", "must be above 0 and at most 1000000");
  }
  arguments.view.most_bytes = arguments.memory_gb * 1e9;
  const GltfScene world = ReadGltf(
      arguments.what, {.target_node = arguments.target,
                       .max_memory_bytes = static_cast<size_t>(arguments.view.most_bytes)});
  for (const std::string& note : world.notes) Tell("note: " + note);
  arguments.view.lighting = LightingFor(arguments, world);
  WriteSceneViews(OutputPath::Folder(arguments.out), world, arguments.view);
  const size_t cameras = CamerasOf(world, arguments.view).size();
  fmt::print("{} view{} of {} in {}\n", cameras, cameras == 1 ? " is" : "s are", arguments.what,
             arguments.out.string());
}

void AddSceneOptions(Command command, RenderArguments& arguments) {
  const auto add = [&command](const char* name, auto& value, const char* help) {
    return command.AddOption(name, value, help).Group("Scene files");
  };
  add("--target", arguments.target, "Name of the node that is the target window");
  add("--camera", arguments.view.camera, "Only this camera of the file");
  add("--width", arguments.view.width_px, "Of the picture, if the file has no camera [px]")
      .Within(16, 8192)
      .ShowDefault();
  add("--height", arguments.view.height_px, "Of the picture, if the file has no camera [px]")
      .Within(16, 8192)
      .ShowDefault();
  const std::map<std::string, Sky::Model> skies = {{"uniform", Sky::Model::kUniform},
                                                   {"cie_overcast", Sky::Model::kCieOvercast},
                                                   {"cie_clear", Sky::Model::kCieClear}};
  command.AddChoice("--sky", arguments.sky_model, skies, "How the sky's light is spread")
      .Group("Scene files");
  add("--sky-lx", arguments.sky_lx, "Illuminance by the sky [lx]").ShowDefault();
  add("--sun-lx", arguments.sun_lx, "Illuminance by the sun; else as in the file, or 0 [lx]");
  add("--sun-azimuth-deg", arguments.sun_azimuth_deg, "From +z towards +x");
  add("--memory-gb", arguments.memory_gb, "Scenes that would need more are refused [GB]")
      .ShowDefault();
  add("--seconds", arguments.view.most_seconds, "Views that would take longer are refused [s]")
      .ShowDefault();
  add("--sun-elevation-deg", arguments.sun_elevation_deg, "Above the horizon");
}

}  // namespace

void AddRenderCommand(Command program) {
  Command command = program.AddCommand(
      "render", "Writes the observation and the truth of one trial, or views of a scene file");
  command.Footer(
      "Examples:\n"
      "  fenestra render paper --cell 2 --trial 5 --out /tmp/trial\n"
      "  fenestra render house.glb --sky cie_clear --sun-lx 60000 --out /tmp/house\n"
      "Of a trial, DIR gets what a detector sees (PNG, YAML) and, in DIR/truth, what it must not "
      "see (JSON, EXR, PCD).\n"
      "Of a glTF file, DIR gets a folder for each camera with pictures and per-pixel truth.");
  const auto arguments = std::make_shared<RenderArguments>();
  command
      .AddOption("STUDY|SCENE", arguments->what, "Name or file of a study, or a .gltf or .glb file")
      .Required();
  command.AddOption("--cell", arguments->cell, "Index of the study's cell").ShowDefault();
  command.AddOption("--trial", arguments->trial, "Index of the trial").ShowDefault();
  const std::map<std::string, SensorKind> sensors = {{"stereo", SensorKind::kStereo},
                                                     {"rgbd", SensorKind::kRgbd}};
  command.AddChoice("--sequence", arguments->sequence, sensors,
                    "Every trial of this sensor, as a sequence that 'score' reads");
  AddPluginOption(command, arguments->plugins);
  command.AddOption("--out", arguments->out, "Folder for the files").Required();
  AddSceneOptions(command, *arguments);
  command.Action([arguments] {
    if (IsSceneFile(arguments->what)) {
      RenderScene(*arguments);
    } else {
      RenderTrial(*arguments);
    }
    return kDone;
  });
}

}  // namespace fenestra::cli
