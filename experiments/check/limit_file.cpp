#include "experiments/check/limit_file.h"

#include <fmt/format.h>

#include "experiments/check/limit_text.h"

namespace fenestra {
namespace {

// What limits were called before; files that have it are read.
constexpr const char* kFormerKey = "bounds";

double ReadProbability(YamlReader& reader, const char* key, double default_value) {
  const YAML::Node node = reader.root()[key];
  if (!node.IsDefined()) return default_value;
  const auto value = reader.Number(node, key);
  if (value && !(*value > 0.0 && *value < 1.0)) {
    reader.AddFault(node, fmt::format("{} must lie between 0 and 1, not be {}", key, *value));
  }
  return value.value_or(default_value);
}

}  // namespace

LimitFile ReadLimitFile(YamlReader reader) {
  static const std::vector<std::string> kKeys = {"study", "false_alarm", "confidence", "limits",
                                                 kFormerKey};
  const YAML::Node& root = reader.root();
  reader.CheckKeys(root, "a file of limits", kKeys);
  if (!root.IsMap()) reader.ThrowIfFaulty();
  LimitFile file;
  if (root["study"].IsDefined()) file.study = reader.Text(root["study"], "study").value_or("");
  file.false_alarm = ReadProbability(reader, "false_alarm", file.false_alarm);
  const double confidence = ReadProbability(reader, "confidence", Limit{}.confidence);
  const bool is_former = !root["limits"].IsDefined() && root[kFormerKey].IsDefined();
  const YAML::Node limits = root[is_former ? kFormerKey : "limits"];
  if (!limits.IsDefined() || !limits.IsSequence() || limits.size() == 0) {
    reader.AddFault(limits.IsDefined() ? limits : root, "limits must be a list of at least one");
    reader.ThrowIfFaulty();
  }
  for (const YAML::Node& node : limits) {
    const auto text = reader.Text(node, "a limit");
    if (!text) continue;
    try {
      file.limits.push_back(ParseLimit(*text, confidence));
      file.limits.back().line = node.Mark().line + 1;
    } catch (const LimitTextError& error) {
      reader.AddFault(node, fmt::format("this limit {}", error.what()));
    }
  }
  reader.ThrowIfFaulty();
  return file;
}

}  // namespace fenestra
