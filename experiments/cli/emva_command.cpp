#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/io/faults.h"
#include "core/io/image_io.h"
#include "core/io/input_error.h"
#include "core/io/temporary_files.h"
#include "experiments/cli/commands.h"
#include "experiments/emva/photon_transfer_picture.h"
#include "experiments/emva/report.h"
#include "experiments/study/factors.h"
#include "sim/camera/spectral_response.h"

namespace fenestra::cli {
namespace {

struct EmvaArguments {
  std::filesystem::path folder;
  bool evaluate_only = false;
  std::vector<std::string> set;  ///< "factor=value"
  emva::SimulationOptions simulation;
  int width_px = 752;
  int height_px = 480;
  int output_bits = 10;
  uint64_t seed = 1;
};

// The factors that a bare sensor in homogeneous light knows of; the others would change nothing.
const std::vector<std::string>& SensorFactors() {
  static const std::vector<std::string> names = {"stereo_quantum_efficiency_scale",
                                                 "stereo_saturation_e",
                                                 "stereo_read_noise_e",
                                                 "stereo_dark_current_e_s",
                                                 "stereo_dark_current_doubling_k",
                                                 "stereo_temperature_c",
                                                 "stereo_dsnu_e",
                                                 "stereo_prnu_percent",
                                                 "stereo_row_noise_e",
                                                 "stereo_adc_bits",
                                                 "stereo_output_bits",
                                                 "stereo_black_level_dn",
                                                 "stereo_noise",
                                                 "stereo_fixed_pattern"};
  return names;
}

// The stereo camera's settings with the factors that the user gave.
TrialSettings SettingsOf(const EmvaArguments& arguments) {
  TrialSettings settings;
  settings.stereo.sensor.output_bits = arguments.output_bits;
  for (const std::string& assignment : arguments.set) {
    const size_t equals = assignment.find('=');
    const std::string name = assignment.substr(0, equals);
    const auto& known = SensorFactors();
    if (equals == std::string::npos || std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError("--set",
                       fmt::format("'{}' is not FACTOR=VALUE with a factor of the stereo sensor.{}",
                                   assignment, DidYouMean(name, known)));
    }
    const ParameterInfo* info = Factors().Find(name);
    YamlReader reader = YamlReader::FromText(assignment.substr(equals + 1), "--set " + name);
    const auto value = info->Read(reader, reader.root());
    reader.ThrowIfFaulty();
    Factors().Set(settings, name, *value);
  }
  return settings;
}

void WriteResults(const OutputPath& folder, const emva::Results& results,
                  const std::optional<emva::PutIn>& put_in) {
  WriteFileAtomically(folder / "report.md", emva::ReportMarkdown(results, put_in));
  WriteFileAtomically(folder / "results.json", emva::ReportJson(results, put_in));
  WritePng(folder / "photon_transfer.png", emva::PhotonTransferPicture(results));
  fmt::print("{}\nIn {}: emva1288.txt, report.md, results.json, photon_transfer.png\n",
             emva::ReportText(results, put_in), folder.path().string());
}

void Emva(const EmvaArguments& arguments) {
  const std::filesystem::path descriptor = arguments.folder / "emva1288.txt";
  const OutputPath folder = OutputPath::Folder(arguments.folder);
  folder.RequireWritable();
  folder.RequireFree({"report.md", "results.json", "photon_transfer.png"});
  if (arguments.evaluate_only) {
    const emva::Series series = emva::ReadDescriptor(descriptor);
    return WriteResults(folder, emva::Evaluate(series, emva::FilesBeside(descriptor, series)), {});
  }
  folder.RequireFree({descriptor.filename().string()});
  const TrialSettings settings = SettingsOf(arguments);
  const ImageSensorOptions& sensor = settings.stereo.sensor;
  emva::SimulationOptions simulation = arguments.simulation;
  simulation.size = {arguments.width_px, arguments.height_px};
  simulation.quantum_efficiency = settings.stereo.spectrum.quantum_efficiency_scale *
                                  QuantumEfficiency(simulation.wavelength_nm);
  const emva::Series series = emva::PlanSeries(simulation, sensor);
  emva::WriteSeries(folder, series,
                    emva::Simulate(simulation, sensor, RandomStream(arguments.seed)));
  // What was written is what is measured.
  const emva::Series written = emva::ReadDescriptor(descriptor);
  WriteResults(folder, emva::Evaluate(written, emva::FilesBeside(descriptor, written)),
               emva::PutInBy(simulation, sensor));
}

// A recorded series is what it is. (CLI11's excludes() would fill the help with names.)
void RefuseOthers(const Command& command) {
  for (const std::string& option : command.GivenOptions()) {
    if (option != "--evaluate-only") {
      throw InputError(option, "does not apply with --evaluate-only");
    }
  }
}

}  // namespace

void AddEmvaCommand(Command program) {
  Command command = program.AddCommand(
      "emva", "Takes an EMVA 1288 series with the stereo camera's sensor and evaluates it");
  command.Footer(
      "Examples:\n"
      "  fenestra emva /tmp/emva\n"
      "  fenestra emva /tmp/emva --output-bits 8 --gain 4 --set stereo_read_noise_e=16\n"
      "  fenestra emva my_camera --evaluate-only     frames of a real camera and their "
      "emva1288.txt");
  const auto arguments = std::make_shared<EmvaArguments>();
  command.AddOption("DIR", arguments->folder, "Folder for the series and its figures").Required();
  command.AddFlag("--evaluate-only", arguments->evaluate_only,
                  "Evaluate the series that is in DIR; no other option applies then");
  command.AddOption("--output-bits", arguments->output_bits, "Bits of the frames").ShowDefault();
  command.AddOption("--gain", arguments->simulation.gain, "Analogue gain").Positive().ShowDefault();
  command.AddOption("--wavelength-nm", arguments->simulation.wavelength_nm, "Of the light")
      .ShowDefault();
  command
      .AddOption("--exposures", arguments->simulation.exposures,
                 "Exposures up to saturation; the standard asks for 50")
      .ShowDefault();
  command
      .AddOption("--frames", arguments->simulation.frames,
                 "Frames of each stack for the spatial figures")
      .ShowDefault();
  command.AddOption("--width-px", arguments->width_px, "Of the frames").ShowDefault();
  command.AddOption("--height-px", arguments->height_px, "Of the frames").ShowDefault();
  command.AddOption("--set", arguments->set,
                    "FACTOR=VALUE, a stereo_… factor of the sensor itself; several times");
  command.AddOption("--seed", arguments->seed, "Of the camera and its noise").ShowDefault();
  command.Action([command, arguments] {
    if (arguments->evaluate_only) RefuseOthers(command);
    Emva(*arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli
