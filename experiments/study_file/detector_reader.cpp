#include "experiments/study_file/detector_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/io/faults.h"

namespace fenestra {
namespace {

constexpr size_t kMostWords = 1000;

// The limit [s] of that name, or the default where it is not given.
double ReadLimit(YamlReader& reader, const YAML::Node& node, const std::string& name,
                 double default_s) {
  const YAML::Node given = node[name];
  if (!given.IsDefined()) return default_s;
  const double limit_s = reader.Number(given, name).value_or(default_s);
  if (!(limit_s > 0.0 && limit_s <= kLongestLimit_s)) {
    reader.AddFault(given, fmt::format("{} must be above 0 and at most {}, not {}", name,
                                       kLongestLimit_s, limit_s));
  }
  return limit_s;
}

DetectorProcess ReadLimits(YamlReader& reader, const YAML::Node& node) {
  DetectorProcess process;
  process.time_limit_s = ReadLimit(reader, node, "time_limit_s", process.time_limit_s);
  process.start_limit_s = ReadLimit(reader, node, "start_limit_s", process.start_limit_s);
  return process;
}

OptionValues ReadFreeOptions(YamlReader& reader, const YAML::Node& node) {
  OptionValues options;
  if (!node.IsMap()) {
    reader.AddFault(node,
                    "options must be a mapping (name: value), not " + YamlReader::Describe(node));
    return options;
  }
  for (const auto& entry : node) {
    const auto name = ReadName(reader, entry.first, "an option's name");
    const auto value = name ? ReadFreeValue(reader, entry.second, *name) : std::nullopt;
    if (value) options[*name] = *value;
  }
  return options;
}

// A detector that is a program of the user's own, without its label.
std::optional<DetectorChoice> ReadExternalDetector(YamlReader& reader, const YAML::Node& node) {
  const size_t before = reader.fault_count();
  reader.CheckKeys(node, "a detector with a command", kProgramKeys);
  DetectorChoice choice{};
  const std::vector<std::string> command = ReadCommand(reader, node["command"]);
  choice.process = ReadLimits(reader, node);
  choice.process->command = command;
  if (const YAML::Node options = node["options"]; options.IsDefined()) {
    choice.options = ReadFreeOptions(reader, options);
  }
  choice.name = ReadName(reader, node["name"], "a detector's name").value_or("");
  if (!node["sensor"].IsDefined()) {
    reader.AddFault(node, "a detector with a command needs a sensor: stereo or rgbd");
    return std::nullopt;
  }
  choice.sensor = ReadSensor(reader, node["sensor"]).value_or(SensorKind::kStereo);
  return reader.IfSoundSince(before, choice);
}

// The process of a detector that Fenestra knows by name: `isolate: true` or false, and then the two
// limits. Without `isolate`, `isolate_by_default` decides.
std::optional<DetectorProcess> ReadIsolation(YamlReader& reader, const YAML::Node& node,
                                             bool isolate_by_default) {
  bool isolate = isolate_by_default;
  if (const YAML::Node word = node["isolate"]; word.IsDefined()) {
    isolate = reader.Boolean(word, "isolate").value_or(false);
  }
  const DetectorProcess process = ReadLimits(reader, node);
  if (isolate) return process;
  for (const char* limit : {"time_limit_s", "start_limit_s"}) {
    if (!node[limit].IsDefined()) continue;
    reader.AddFault(node[limit], fmt::format("{} has no effect without isolate: true", limit));
  }
  return std::nullopt;
}

const DetectorInfo* Find(std::span<const DetectorInfo> known, const std::string& name) {
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&name](const DetectorInfo& info) { return info.name == name; });
  return found == known.end() ? nullptr : &*found;
}

const DetectorInfo* ReadDetectorName(YamlReader& reader, const YAML::Node& node,
                                     std::span<const DetectorInfo> known) {
  const auto name = reader.Text(node, "a detector's name");
  if (!name) return nullptr;
  const DetectorInfo* info = Find(known, *name);
  if (info == nullptr) {
    std::vector<std::string> names;
    for (const DetectorInfo& detector : known) names.push_back(detector.name);
    std::string hint = DidYouMean(*name, names);
    if (hint.empty()) hint = fmt::format(" Known: {}.", fmt::join(names, ", "));
    reader.AddFault(node, fmt::format("unknown detector '{}'.{}", *name, hint));
  }
  return info;
}

OptionValues ReadOptions(YamlReader& reader, const YAML::Node& node, const DetectorInfo& info) {
  std::vector<std::string> names;
  for (const ParameterInfo& option : info.options) names.push_back(option.name);
  reader.CheckKeys(node, "options of " + info.name, names);
  OptionValues values = DefaultChoice(info).options;
  if (!node.IsMap()) return values;
  for (const ParameterInfo& option : info.options) {
    const YAML::Node given = node[option.name];
    if (!given.IsDefined()) continue;
    if (const auto value = option.Read(reader, given)) values[option.name] = *value;
  }
  return values;
}

// The label, which is the detector's name unless another one is given.
std::string ReadLabel(YamlReader& reader, const YAML::Node& node, const std::string& name) {
  const YAML::Node label = node["label"];
  if (!label.IsDefined()) return name;
  return ReadName(reader, label, "a detector's label").value_or(name);
}

std::optional<GivenDetector> ReadProgram(YamlReader& reader, const YAML::Node& node,
                                         std::span<const DetectorInfo> known) {
  const size_t before = reader.fault_count();
  if (!node["name"].IsDefined()) {
    reader.AddFault(node, "a detector needs a name");
    return std::nullopt;
  }
  auto choice = ReadExternalDetector(reader, node);
  if (!choice) return std::nullopt;
  if (Find(known, choice->name) != nullptr) {
    reader.AddFault(node["name"], fmt::format("'{}' is a detector of this program: call the one "
                                              "with a command otherwise",
                                              choice->name));
    return std::nullopt;
  }
  choice->label = ReadLabel(reader, node, choice->name);
  return reader.IfSoundSince(before, GivenDetector{*choice, node});
}

std::optional<GivenDetector> ReadDetector(YamlReader& reader, const YAML::Node& node,
                                          std::span<const DetectorInfo> known) {
  if (!node.IsMap()) {
    const DetectorInfo* info = ReadDetectorName(reader, node, known);
    return info ? std::optional(GivenDetector{DefaultChoice(*info), node}) : std::nullopt;
  }
  if (node["command"].IsDefined()) return ReadProgram(reader, node, known);
  const size_t before = reader.fault_count();
  reader.CheckKeys(node, "a detector", kDetectorKeys);
  if (!node["name"].IsDefined()) {
    reader.AddFault(node, "a detector needs a name");
    return std::nullopt;
  }
  const DetectorInfo* info = ReadDetectorName(reader, node["name"], known);
  if (info == nullptr) return std::nullopt;
  GivenDetector given{DefaultChoice(*info), node};
  given.choice.label = ReadLabel(reader, node, info->name);
  given.choice.process = ReadIsolation(reader, node, info->isolate);
  if (const YAML::Node options = node["options"]; options.IsDefined()) {
    given.choice.options = ReadOptions(reader, options, *info);
  }
  return reader.IfSoundSince(before, given);
}

}  // namespace

std::optional<std::vector<GivenDetector>> ReadDetectors(YamlReader& reader, const YAML::Node& node,
                                                        std::span<const DetectorInfo> known) {
  if (!node.IsSequence() || node.size() == 0) {
    reader.AddFault(node, fmt::format("detectors must be a list of at least one detector, not {}",
                                      YamlReader::Describe(node)));
    return std::nullopt;
  }
  const size_t before = reader.fault_count();
  std::vector<GivenDetector> detectors;
  for (const YAML::Node& item : node) {
    const auto detector = ReadDetector(reader, item, known);
    if (!detector) continue;
    const std::string& label = detector->choice.label;
    if (std::any_of(detectors.begin(), detectors.end(),
                    [&label](const GivenDetector& d) { return d.choice.label == label; })) {
      reader.AddFault(item, fmt::format("two detectors are called '{}': give this one a label of "
                                        "its own",
                                        label));
    }
    detectors.push_back(*detector);
  }
  return reader.IfSoundSince(before, detectors);
}

std::vector<std::string> ReadCommand(YamlReader& reader, const YAML::Node& node) {
  std::vector<std::string> words;
  if (!node.IsSequence() || node.size() == 0 || node.size() > kMostWords) {
    reader.AddFault(node, fmt::format("command must be a list of words such as [python3, mine.py], "
                                      "not {}",
                                      YamlReader::Describe(node)));
    return words;
  }
  for (const YAML::Node& item : node) {
    const auto word = reader.Text(item, "a word of command");
    if (!word) return {};
    words.push_back(*word);
  }
  if (words.front().empty()) reader.AddFault(node, "command must name a program first");
  return words;
}

std::optional<ParameterValue> ReadFreeValue(YamlReader& reader, const YAML::Node& node,
                                            const std::string& name) {
  if (!node.IsScalar()) {
    reader.AddFault(node, fmt::format("{} must be a switch, a number or a text, not {}", name,
                                      YamlReader::Describe(node)));
    return std::nullopt;
  }
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;
  if (text == "true" || text == "false") return text == "true";
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc() && rest == end && std::isfinite(number)) return number;
  return text;
}

std::optional<SensorKind> ReadSensor(YamlReader& reader, const YAML::Node& node) {
  const auto name = reader.Text(node, "a sensor");
  if (!name) return std::nullopt;
  const auto sensor = ParseSensorKind(*name);
  if (!sensor) {
    reader.AddFault(node, fmt::format("unknown sensor '{}'. Known: {}, {}.", *name,
                                      ToString(SensorKind::kStereo), ToString(SensorKind::kRgbd)));
  }
  return sensor;
}

std::optional<std::string> ReadName(YamlReader& reader, const YAML::Node& node,
                                    const std::string& what) {
  auto name = reader.Text(node, what);
  if (!name) return std::nullopt;
  const bool good =
      !name->empty() && name->size() <= 64 &&
      name->find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
  if (good) return name;
  reader.AddFault(node, fmt::format("{} must be 1 to 64 of the characters a-z 0-9 _ -, not {}",
                                    what, YamlReader::Describe(node)));
  return std::nullopt;
}

}  // namespace fenestra
