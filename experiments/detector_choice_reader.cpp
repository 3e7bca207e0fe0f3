#include "experiments/detector_choice_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/did_you_mean.h"
#include "experiments/detector_process_reader.h"
#include "experiments/factor_reader.h"

namespace fenestra {
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

DetectorChoice DefaultChoice(const DetectorInfo& detector) {
  DetectorChoice choice{
      .label = detector.name, .name = detector.name, .sensor = detector.sensor, .options = {}};
  if (detector.isolate) choice.process = DetectorProcess{};
  for (const ParameterInfo& option : detector.options) {
    choice.options[option.name] = WrittenDefault(option);
  }
  return choice;
}

std::optional<std::string> ReadName(YamlReader& reader, const YAML::Node& node,
                                    const std::string& what) {
  const auto name = reader.Text(node, what);
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
