#include "experiments/stopping_rule.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/check.h"
#include "experiments/statistics/looks.h"

namespace fenestra {
namespace {

constexpr const char* kFirstLook = "first_look";
constexpr int kMostFirstLook = 100'000;

}  // namespace

const char* ToString(StoppingFigure figure) {
  switch (figure) {
    case StoppingFigure::kHitRate:
      return "hit_rate";
    case StoppingFigure::kFalseAlarmRate:
      return "false_alarm_rate";
    case StoppingFigure::kP50Error:
      return "p50_error_mm";
    case StoppingFigure::kP95Error:
      return "p95_error_mm";
    case StoppingFigure::kBias:
      return "bias_mm";
    case StoppingFigure::kRmse:
      return "rmse_mm";
  }
  FENESTRA_CHECK(false, "figure out of range");
}

int StoppingRule::CountLooks(int repetitions) const {
  return static_cast<int>(Looks(first_look, repetitions).size());
}

std::optional<StoppingRule> ReadStoppingRule(YamlReader& reader, const YAML::Node& node) {
  if (!reader.CheckKeys(node, "until", StoppingKeys())) return std::nullopt;
  StoppingRule rule;
  bool good = true;
  if (const YAML::Node first = node[kFirstLook]; first.IsDefined()) {
    const auto look = reader.Integer(first, kFirstLook, 1, kMostFirstLook);
    good = look.has_value();
    rule.first_look = static_cast<int>(look.value_or(1));
  }
  for (const StoppingFigure figure : kAllStoppingFigures) {
    const YAML::Node given = node[ToString(figure)];
    if (!given.IsDefined()) continue;
    const auto width = reader.Number(given, ToString(figure));
    if (width && *width > 0.0) {
      rule.targets.push_back({figure, *width});
      continue;
    }
    if (width) {
      reader.AddFault(given, fmt::format("{} must be the width of an interval, greater than 0",
                                         ToString(figure)));
    }
    good = false;
  }
  if (good && rule.targets.empty()) {
    reader.AddFault(node,
                    fmt::format("until needs the width of at least one of {}",
                                fmt::join(StoppingKeys().begin(), StoppingKeys().end() - 1, ", ")));
    good = false;
  }
  return good ? std::optional(rule) : std::nullopt;
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

}  // namespace fenestra
