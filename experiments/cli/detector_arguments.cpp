#include "experiments/cli/detector_arguments.h"

#include <fmt/format.h>

#include "core/geometry/calibration_entries.h"
#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/study_file/detector_reader.h"
#include "vision/plugin_loader.h"

namespace fenestra::cli {
namespace {

struct NameAndValue {
  std::string name;
  std::string value;
};

NameAndValue Split(const std::string& option) {
  const size_t equals = option.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("--option", fmt::format("'{}' is not NAME=VALUE", option));
  }
  return {option.substr(0, equals), option.substr(equals + 1)};
}

ParameterValue ReadOption(const DetectorInfo& detector, const NameAndValue& given) {
  std::vector<std::string> known;
  for (const ParameterInfo& info : detector.options) {
    known.push_back(info.name);
    if (info.name != given.name) continue;
    YamlReader reader = YamlReader::FromText(given.value, "--option " + given.name);
    const auto value = info.Read(reader, reader.root());
    reader.ThrowIfFaulty();
    return *value;
  }
  throw InputError("--option", fmt::format("{} has no option '{}'.{}", detector.name, given.name,
                                           DidYouMean(given.name, known)));
}

const DetectorInfo& DetectorFor(const std::string& name, SensorKind sensor) {
  const DetectorInfo* info = FindDetector(name);
  if (info != nullptr && info->sensor == sensor) return *info;
  std::vector<std::string> names;
  for (const DetectorInfo& detector : Detectors()) {
    if (detector.sensor == sensor) names.push_back(detector.name);
  }
  throw InputError("--detector",
                   fmt::format("there is no {} detector '{}'.{} Known: {}.", ToString(sensor), name,
                               DidYouMean(name, names), fmt::join(names, ", ")));
}

std::vector<std::string> WordsOf(const std::string& command) {
  YamlReader reader = YamlReader::FromText(command, "--command");
  if (reader.root().IsScalar()) return {command};
  std::vector<std::string> words = ReadCommand(reader, reader.root());
  reader.ThrowIfFaulty();
  return words;
}

DetectorChoice ProgramChoice(const DetectorArguments& arguments, SensorKind sensor) {
  DetectorChoice choice{.label = "command", .name = "command", .sensor = sensor, .options = {}};
  choice.process = DetectorProcess{.command = WordsOf(arguments.command)};
  for (const std::string& option : arguments.options) {
    const NameAndValue given = Split(option);
    YamlReader reader = YamlReader::FromText(given.value, "--option " + given.name);
    const auto value = ReadFreeValue(reader, reader.root(), given.name);
    reader.ThrowIfFaulty();
    choice.options[given.name] = *value;
  }
  return choice;
}

}  // namespace

void AddDetectorOptions(Command command, DetectorArguments& arguments) {
  const Option detector =
      command.AddOption("--detector", arguments.detector, "Name of the detector").ShowDefault();
  command
      .AddOption("--option", arguments.options,
                 "NAME=VALUE of the detector; may be given several times")
      .OneValueEach();
  command
      .AddOption("--command", arguments.command,
                 "A program that is the detector: '[python3, mine.py]'")
      .Excludes(detector);
  command.AddFlag("--isolate", arguments.isolate, "Run the detector in a process of its own");
  command
      .AddOption("--time-limit-s", arguments.time_limit_s,
                 "For an answer of a detector that runs in a process of its own")
      .Positive();
  AddPluginOption(command, arguments.plugins);
}

DetectorChoice ChooseDetector(const DetectorArguments& arguments, SensorKind sensor) {
  LoadPlugins(arguments.plugins);
  DetectorChoice choice;
  if (!arguments.command.empty()) {
    choice = ProgramChoice(arguments, sensor);
  } else {
    const DetectorInfo& info = DetectorFor(arguments.detector, sensor);
    choice = DefaultChoice(info);
    for (const std::string& option : arguments.options) {
      const NameAndValue given = Split(option);
      choice.options[given.name] = ReadOption(info, given);
    }
    choice.process.reset();  // A person waits for it and sees a crash; stages have pictures.
    if (arguments.isolate) choice.process = DetectorProcess{};
  }
  if (arguments.time_limit_s) {
    if (!choice.process) throw InputError("--time-limit-s", "has no effect without --isolate");
    choice.process->time_limit_s = *arguments.time_limit_s;
  }
  return choice;
}

void NoteAssumedDepthUnit(const std::filesystem::path& calibration) {
  if (StatesDepthUnit(calibration)) return;
  Tell(fmt::format("note: {} states no depth_unit_m: units of 1 mm are assumed",
                   calibration.string()));
}

void AddPluginOption(Command command, std::vector<std::filesystem::path>& plugins) {
  command
      .AddOption("--plugin", plugins, "Shared library with detectors; may be given several times")
      .TypeName("LIBRARY")
      .OneValueEach();
}

void LoadPlugins(const std::vector<std::filesystem::path>& plugins) {
  for (const std::filesystem::path& plugin : plugins) LoadPlugin(plugin);
}

std::shared_ptr<DetectorMaker> MakerWith(const std::vector<std::filesystem::path>& plugins) {
  std::vector<std::string> serve = {std::filesystem::read_symlink("/proc/self/exe").string(),
                                    "serve"};
  for (const std::filesystem::path& plugin : plugins) {
    serve.push_back("--plugin");
    serve.push_back(std::filesystem::absolute(plugin).string());
  }
  return std::make_shared<DetectorMaker>(serve);
}

}  // namespace fenestra::cli
