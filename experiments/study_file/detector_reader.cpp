#include "experiments/study_file/detector_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/io/faults.h"
#include "experiments/study_file/name_reader.h"

namespace fenestra {
namespace {

constexpr size_t kMostWords = 1000;

bool ReadLimit(YamlReader& reader, const YAML::Node& node, const std::string& name,
               double& limit_s) {
  const YAML::Node given = node[name];
  if (!given.IsDefined()) return true;
  const auto value = reader.Number(given, name);
  if (!value) return false;
  if (!(*value > 0.0 && *value <= kLongestLimit_s)) {
    reader.AddFault(given, fmt::format("{} must be above 0 and at most {}, not {}", name,
                                       kLongestLimit_s, *value));
    return false;
  }
  limit_s = *value;
  return true;
}

bool ReadLimits(YamlReader& reader, const YAML::Node& node, DetectorProcess& process) {
  const bool time = ReadLimit(reader, node, "time_limit_s", process.time_limit_s);
  return ReadLimit(reader, node, "start_limit_s", process.start_limit_s) && time;
}

bool ReadFreeOptions(YamlReader& reader, const YAML::Node& node, OptionValues& options) {
  if (!node.IsMap()) {
    reader.AddFault(node,
                    "options must be a mapping (name: value), not " + YamlReader::Describe(node));
    return false;
  }
  bool good = true;
  for (const auto& entry : node) {
    const auto name = ReadName(reader, entry.first, "an option's name");
    const auto value = name ? ReadFreeValue(reader, entry.second, *name) : std::nullopt;
    good = good && value;
    if (value) options[*name] = *value;
  }
  return good;
}

}  // namespace

bool ReadCommand(YamlReader& reader, const YAML::Node& node, std::vector<std::string>& words) {
  if (!node.IsSequence() || node.size() == 0 || node.size() > kMostWords) {
    reader.AddFault(node, fmt::format("command must be a list of words such as [python3, mine.py], "
                                      "not {}",
                                      YamlReader::Describe(node)));
    return false;
  }
  for (const YAML::Node& item : node) {
    const auto word = reader.Text(item, "a word of command");
    if (!word) return false;
    words.push_back(*word);
  }
  if (words.front().empty()) reader.AddFault(node, "command must name a program first");
  return !words.front().empty();
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

std::optional<DetectorChoice> ReadExternalDetector(YamlReader& reader, const YAML::Node& node) {
  bool good = reader.CheckKeys(node, "a detector with a command", kProgramKeys);
  DetectorChoice choice{.label = {},
                        .name = {},
                        .sensor = SensorKind::kStereo,
                        .options = {},
                        .process = DetectorProcess{}};
  good = ReadCommand(reader, node["command"], choice.process->command) && good;
  good = ReadLimits(reader, node, *choice.process) && good;
  if (const YAML::Node options = node["options"]; options.IsDefined()) {
    good = ReadFreeOptions(reader, options, choice.options) && good;
  }
  const auto name = ReadName(reader, node["name"], "a detector's name");
  choice.name = name.value_or("");
  if (!node["sensor"].IsDefined()) {
    reader.AddFault(node, "a detector with a command needs a sensor: stereo or rgbd");
    return std::nullopt;
  }
  const auto sensor = ReadSensor(reader, node["sensor"]);
  choice.sensor = sensor.value_or(SensorKind::kStereo);
  return good && name && sensor ? std::optional(choice) : std::nullopt;
}

GivenProcess ReadIsolation(YamlReader& reader, const YAML::Node& node, bool isolate_by_default) {
  GivenProcess given;
  bool isolate = isolate_by_default;
  if (const YAML::Node word = node["isolate"]; word.IsDefined()) {
    const auto value = reader.Boolean(word, "isolate");
    given.good = value.has_value();
    isolate = value.value_or(false);
  }
  DetectorProcess process;
  given.good = ReadLimits(reader, node, process) && given.good;
  if (isolate) given.process = process;
  for (const char* limit : {"time_limit_s", "start_limit_s"}) {
    if (isolate || !node[limit].IsDefined()) continue;
    reader.AddFault(node[limit], fmt::format("{} has no effect without isolate: true", limit));
    given.good = false;
  }
  return given;
}

namespace {

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

std::optional<OptionValues> ReadOptions(YamlReader& reader, const YAML::Node& node,
                                        const DetectorInfo& info) {
  std::vector<std::string> names;
  for (const ParameterInfo& option : info.options) names.push_back(option.name);
  bool good = reader.CheckKeys(node, "options of " + info.name, names);
  if (!node.IsMap()) return std::nullopt;
  OptionValues values = DefaultChoice(info).options;
  for (const ParameterInfo& option : info.options) {
    const YAML::Node given = node[option.name];
    if (!given.IsDefined()) continue;
    const auto value = option.Read(reader, given);
    if (value) values[option.name] = *value;
    good = good && value.has_value();
  }
  return good ? std::optional(values) : std::nullopt;
}

bool ReadLabel(YamlReader& reader, const YAML::Node& node, DetectorChoice& choice) {
  const YAML::Node label = node["label"];
  if (!label.IsDefined()) return true;
  const auto text = ReadName(reader, label, "a detector's label");
  choice.label = text.value_or("");
  return text.has_value();
}

std::optional<GivenDetector> ReadProgram(YamlReader& reader, const YAML::Node& node,
                                         std::span<const DetectorInfo> known) {
  if (!node["name"].IsDefined()) {
    reader.AddFault(node, "a detector needs a name");
    return std::nullopt;
  }
  auto choice = ReadExternalDetector(reader, node);
  if (!choice) return std::nullopt;
  choice->label = choice->name;
  if (Find(known, choice->name) != nullptr) {
    reader.AddFault(node["name"], fmt::format("'{}' is a detector of this program: call the one "
                                              "with a command otherwise",
                                              choice->name));
    return std::nullopt;
  }
  return ReadLabel(reader, node, *choice) ? std::optional(GivenDetector{*choice, node})
                                          : std::nullopt;
}

std::optional<GivenDetector> ReadDetector(YamlReader& reader, const YAML::Node& node,
                                          std::span<const DetectorInfo> known) {
  if (!node.IsMap()) {
    const DetectorInfo* info = ReadDetectorName(reader, node, known);
    return info ? std::optional(GivenDetector{DefaultChoice(*info), node}) : std::nullopt;
  }
  if (node["command"].IsDefined()) return ReadProgram(reader, node, known);
  bool good = reader.CheckKeys(node, "a detector", kDetectorKeys);
  if (!node["name"].IsDefined()) {
    reader.AddFault(node, "a detector needs a name");
    return std::nullopt;
  }
  const DetectorInfo* info = ReadDetectorName(reader, node["name"], known);
  if (info == nullptr) return std::nullopt;
  GivenDetector given{DefaultChoice(*info), node};
  good = ReadLabel(reader, node, given.choice) && good;
  const GivenProcess isolation = ReadIsolation(reader, node, info->isolate);
  good = isolation.good && good;
  given.choice.process = isolation.process;
  if (const YAML::Node options = node["options"]; options.IsDefined()) {
    const auto values = ReadOptions(reader, options, *info);
    good = good && values.has_value();
    given.choice.options = values.value_or(OptionValues{});
  }
  return good ? std::optional(given) : std::nullopt;
}

}  // namespace

std::optional<std::vector<GivenDetector>> ReadDetectors(YamlReader& reader, const YAML::Node& node,
                                                        std::span<const DetectorInfo> known) {
  if (!node.IsSequence() || node.size() == 0) {
    reader.AddFault(node, fmt::format("detectors must be a list of at least one detector, not {}",
                                      YamlReader::Describe(node)));
    return std::nullopt;
  }
  std::vector<GivenDetector> detectors;
  bool good = true;
  for (const YAML::Node& item : node) {
    const auto detector = ReadDetector(reader, item, known);
    good = good && detector.has_value();
    if (!detector) continue;
    const std::string& label = detector->choice.label;
    if (std::any_of(detectors.begin(), detectors.end(),
                    [&label](const GivenDetector& d) { return d.choice.label == label; })) {
      reader.AddFault(item, fmt::format("two detectors are called '{}': give this one a label of "
                                        "its own",
                                        label));
      good = false;
    }
    detectors.push_back(*detector);
  }
  return good ? std::optional(detectors) : std::nullopt;
}

}  // namespace fenestra
