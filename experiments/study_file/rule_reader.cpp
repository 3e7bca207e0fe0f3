#include "experiments/study_file/rule_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/faults.h"
#include "experiments/study/factors.h"
#include "experiments/study/metric.h"

namespace fenestra {
namespace {

constexpr const char* kFirstLook = "first_look";
constexpr int kMostFirstLook = 100'000;

struct OpenRange {
  double above;
  double below;
};

std::optional<double> ReadWithin(YamlReader& reader, const YAML::Node& node, const char* what,
                                 OpenRange range, const char* allowed) {
  const auto number = reader.Number(node, what);
  if (!number || (*number > range.above && *number < range.below)) return number;
  reader.AddFault(node, fmt::format("{} must be {}, not {:g}", what, allowed, *number));
  return std::nullopt;
}

std::optional<std::vector<Demand>> ReadRequirement(YamlReader& reader, const YAML::Node& node) {
  constexpr double kMostMm = 1e6;
  if (!reader.CheckKeys(node, "require", RequirementMetrics())) return std::nullopt;
  const size_t before = reader.fault_count();
  std::vector<Demand> demands;
  for (const std::string& name : RequirementMetrics()) {
    if (!node[name].IsDefined()) continue;
    const bool is_share = FindMetric(name)->IsShare();
    const auto number = ReadWithin(
        reader, node[name], name.c_str(), {0.0, is_share ? 1.0 : kMostMm},
        is_share ? "a share greater than 0 and less than 1" : "a length in mm greater than 0");
    if (number) demands.push_back({name, *number});
  }
  if (reader.fault_count() == before && demands.empty()) {
    reader.AddFault(node, fmt::format("require needs at least one of {}",
                                      fmt::join(RequirementMetrics(), ", ")));
  }
  return reader.IfSoundSince(before, demands);
}

}  // namespace

std::optional<StoppingRule> ReadStoppingRule(YamlReader& reader, const YAML::Node& node) {
  if (!reader.CheckKeys(node, "until", StoppingKeys())) return std::nullopt;
  const size_t before = reader.fault_count();
  StoppingRule rule;
  if (const YAML::Node first = node[kFirstLook]; first.IsDefined()) {
    rule.first_look =
        static_cast<int>(reader.Integer(first, kFirstLook, 1, kMostFirstLook).value_or(1));
  }
  for (const std::string& metric : StoppingMetrics()) {
    const YAML::Node given = node[metric];
    if (!given.IsDefined()) continue;
    const auto width = reader.Number(given, metric.c_str());
    if (!width) continue;
    rule.targets.push_back({metric, *width});
    if (*width > 0.0) continue;
    reader.AddFault(given,
                    fmt::format("{} must be the width of an interval, greater than 0", metric));
  }
  if (reader.fault_count() == before && rule.targets.empty()) {
    reader.AddFault(node,
                    fmt::format("until needs the width of at least one of {}",
                                fmt::join(StoppingKeys().begin(), StoppingKeys().end() - 1, ", ")));
  }
  return reader.IfSoundSince(before, rule);
}

const std::vector<std::string>& StoppingKeys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> names = StoppingMetrics();
    names.push_back(kFirstLook);
    return names;
  }();
  return keys;
}

std::optional<EnvelopeRule> ReadEnvelopeRule(YamlReader& reader, const YAML::Node& node) {
  if (!reader.CheckKeys(node, "an envelope", kEnvelopeKeys)) return std::nullopt;
  if (!node["over"].IsDefined() || !node["require"].IsDefined()) {
    reader.AddFault(node, "an envelope must be {over: FACTOR, require: {hit_rate: 0.95}}");
    return std::nullopt;
  }
  EnvelopeRule rule;
  const auto over = reader.Text(node["over"], "over");
  const auto require = ReadRequirement(reader, node["require"]);
  std::optional<double> confidence = rule.confidence;
  if (const YAML::Node given = node["confidence"]; given.IsDefined()) {
    confidence = ReadWithin(reader, given, "confidence", {0.5, 1.0},
                            "a number greater than 0.5 and less than 1");
  }
  if (!over || !require || !confidence) return std::nullopt;
  if (Factors().Find(*over) == nullptr) {
    reader.AddFault(node["over"], fmt::format("unknown factor '{}'.{}", *over,
                                              DidYouMean(*over, Factors().Names())));
    return std::nullopt;
  }
  return EnvelopeRule{.over = *over, .require = *require, .confidence = *confidence};
}

}  // namespace fenestra
