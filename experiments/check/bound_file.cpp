#include "experiments/check/bound_file.h"

#include <fmt/format.h>

#include "experiments/check/bound_text.h"

namespace fenestra {
namespace {

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

BoundFile ReadBoundFile(YamlReader reader) {
  static const std::vector<std::string> kKeys = {"study", "false_alarm", "confidence", "bounds"};
  const YAML::Node& root = reader.root();
  reader.CheckKeys(root, "a file of bounds", kKeys);
  if (!root.IsMap()) reader.ThrowIfFaulty();
  BoundFile file;
  if (root["study"].IsDefined()) file.study = reader.Text(root["study"], "study").value_or("");
  file.false_alarm = ReadProbability(reader, "false_alarm", file.false_alarm);
  const double confidence = ReadProbability(reader, "confidence", Bound{}.confidence);
  const YAML::Node bounds = root["bounds"];
  if (!bounds.IsDefined() || !bounds.IsSequence() || bounds.size() == 0) {
    reader.AddFault(bounds.IsDefined() ? bounds : root, "bounds must be a list of at least one");
    reader.ThrowIfFaulty();
  }
  for (const YAML::Node& node : bounds) {
    const auto text = reader.Text(node, "a bound");
    if (!text) continue;
    try {
      file.bounds.push_back(ParseBound(*text, confidence));
      file.bounds.back().line = node.Mark().line + 1;
    } catch (const BoundTextError& error) {
      reader.AddFault(node, fmt::format("this bound {}", error.what()));
    }
  }
  reader.ThrowIfFaulty();
  return file;
}

}  // namespace fenestra
