#include "experiments/detector_process_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "experiments/detector_choice_reader.h"
#include "experiments/study_blocks.h"

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

}  // namespace fenestra
