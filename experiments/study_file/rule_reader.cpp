#include "experiments/study_file/rule_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/faults.h"
#include "experiments/study/factors.h"

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

std::optional<Requirement> ReadRequirement(YamlReader& reader, const YAML::Node& node) {
  constexpr double kMostMm = 1e6;
  if (!reader.CheckKeys(node, "require", kRequirementKeys)) return std::nullopt;
  const size_t before = reader.fault_count();
  Requirement requirement;
  if (const YAML::Node rate = node["hit_rate"]; rate.IsDefined()) {
    requirement.hit_rate =
        ReadWithin(reader, rate, "hit_rate", {0.0, 1.0}, "a share greater than 0 and less than 1")
            .value_or(0.0);
  }
  const auto read_error = [&](const char* key) -> std::optional<double> {
    if (!node[key].IsDefined()) return std::nullopt;
    return ReadWithin(reader, node[key], key, {0.0, kMostMm}, "a length in mm greater than 0");
  };
  requirement.p50_error_mm = read_error("p50_error_mm");
  requirement.p95_error_mm = read_error("p95_error_mm");
  if (reader.fault_count() == before && requirement == Requirement{}) {
    reader.AddFault(
        node, fmt::format("require needs at least one of {}", fmt::join(kRequirementKeys, ", ")));
  }
  return reader.IfSoundSince(before, requirement);
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
  for (const StoppingFigure figure : kAllStoppingFigures) {
    const YAML::Node given = node[ToString(figure)];
    if (!given.IsDefined()) continue;
    const auto width = reader.Number(given, ToString(figure));
    if (!width) continue;
    rule.targets.push_back({figure, *width});
    if (*width > 0.0) continue;
    reader.AddFault(given, fmt::format("{} must be the width of an interval, greater than 0",
                                       ToString(figure)));
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
    std::vector<std::string> names;
    for (const StoppingFigure figure : kAllStoppingFigures) names.push_back(ToString(figure));
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
