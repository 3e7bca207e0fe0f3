#include "experiments/study_file/factor_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace fenestra {
namespace {

// Reads the setting of one factor.
class SettingReader {
 public:
  SettingReader(YamlReader& reader, const ParameterInfo& factor)
      : reader_(reader), factor_(factor) {}

  std::optional<Levels> ReadLevels(const YAML::Node& node) {
    if (node.size() == 0) return Fault<Levels>(node, "has an empty list of levels");
    const size_t before = reader_.fault_count();
    Levels levels;
    for (const YAML::Node& item : node) {
      const auto level = factor_.Read(reader_, item);
      if (!level) continue;
      if (std::find(levels.begin(), levels.end(), *level) != levels.end()) {
        Fault<Levels>(item, fmt::format("has the level {} twice", ToString(*level)));
      }
      levels.push_back(*level);
    }
    return reader_.IfSoundSince(before, levels);
  }

  std::optional<Levels> ReadRange(const YAML::Node& node) {
    if (!IsNumeric()) return Fault<Levels>(node, "has no range: give a value or a list");
    const auto from = Number(node, node["from"], "from");
    const auto to = Number(node, node["to"], "to");
    const auto intervals = CountIntervals(node, from, to);
    if (!from || !to || !intervals) return std::nullopt;
    Levels levels;
    const double negligible = 1e-12 * std::max(std::abs(*from), std::abs(*to));
    for (int64_t i = 0; i <= *intervals; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(*intervals);
      double level = *from + share * (*to - *from);
      if (std::abs(level) < negligible) level = 0.0;  // -0.3 + 3 · 0.1 was meant to be 0.
      levels.emplace_back(RoundTo12Digits(level));
    }
    for (const ParameterValue& level : levels) {
      if (const auto objection = factor_.Objection(level)) {
        reader_.AddFault(node, *objection);
        return std::nullopt;
      }
    }
    return levels;
  }

  std::optional<Distribution> ReadDistribution(const YAML::Node& node, const std::string& kind) {
    if (factor_.type != ParameterInfo::Type::kNumber) {
      return Fault<Distribution>(node, "cannot be drawn: give a value or a list");
    }
    const YAML::Node body = node[kind];
    std::optional<Distribution> drawn;
    if (kind == "uniform") drawn = ReadUniform<UniformDistribution>(body, kind);
    if (kind == "log_uniform") drawn = ReadUniform<LogUniformDistribution>(body, kind);
    if (kind == "triangular") drawn = ReadTriangular(body);
    if (kind == "normal") drawn = ReadNormal(body);
    if (!drawn) return std::nullopt;
    if (Lowest(*drawn) < factor_.min || Highest(*drawn) > factor_.max) {
      return Fault<Distribution>(
          body, fmt::format("must stay from {:g} to {:g}, but is drawn from {:g} to {:g}",
                            factor_.min, factor_.max, Lowest(*drawn), Highest(*drawn)));
    }
    return drawn;
  }

 private:
  template <typename T>
  std::optional<T> Fault(const YAML::Node& at, const std::string& message) {
    reader_.AddFault(at, factor_.name + " " + message);
    return std::nullopt;
  }

  bool IsNumeric() const {
    return factor_.type == ParameterInfo::Type::kNumber ||
           factor_.type == ParameterInfo::Type::kInteger;
  }

  std::optional<double> Number(const YAML::Node& mapping, const YAML::Node& node,
                               const std::string& key) {
    if (node.IsDefined()) return reader_.Number(node, fmt::format("{} of {}", key, factor_.name));
    return Fault<double>(mapping, fmt::format("lacks '{}'", key));
  }

  // How many steps lead from `from` to `to`.
  std::optional<int64_t> CountIntervals(const YAML::Node& node, std::optional<double> from,
                                        std::optional<double> to) {
    const YAML::Node step = node["step"];
    const YAML::Node count = node["count"];
    if (step.IsDefined() == count.IsDefined()) {
      return Fault<int64_t>(node, "needs either a step or a count for its range");
    }
    if (count.IsDefined()) {
      const auto levels = reader_.Integer(count, "count of " + factor_.name, 2, kMostCells);
      if (levels && from && to)
        return CheckOrder(node, *from, *to) ? std::optional(*levels - 1) : std::nullopt;
      return std::nullopt;
    }
    const auto size = Number(node, step, "step");
    if (!size || !from || !to || !CheckOrder(node, *from, *to)) return std::nullopt;
    if (*size <= 0.0) return Fault<int64_t>(step, "needs a step greater than 0");
    return DivideRange(step, *to - *from, *size);
  }

  bool CheckOrder(const YAML::Node& node, double from, double to) {
    if (from >= to) Fault<double>(node, fmt::format("has a range from {:g} to {:g}", from, to));
    return from < to;
  }

  std::optional<int64_t> DivideRange(const YAML::Node& at, double range, double step) {
    const double intervals = range / step;
    if (intervals >= static_cast<double>(kMostCells)) {
      return Fault<int64_t>(at, fmt::format("has more than {} levels", kMostCells));
    }
    const double whole = std::round(intervals);
    if (whole < 1.0 || std::abs(intervals - whole) > 1e-9 * intervals) {
      return Fault<int64_t>(
          at, fmt::format("has a step of {:g}, which does not divide its range of {:g}; {:g} would",
                          step, range, range / std::max(1.0, std::ceil(intervals))));
    }
    return static_cast<int64_t>(whole);
  }

  template <typename Uniform>
  std::optional<Distribution> ReadUniform(const YAML::Node& body, const std::string& kind) {
    const auto ends = reader_.Numbers(body, fmt::format("{} of {}", kind, factor_.name), 2);
    if (!ends) return std::nullopt;
    const double min = ends->front();
    const double max = ends->back();
    if (min >= max) return Fault<Distribution>(body, "needs [min, max] with min less than max");
    if (std::is_same_v<Uniform, LogUniformDistribution> && min <= 0.0) {
      return Fault<Distribution>(body, "needs a min greater than 0 to be log_uniform");
    }
    return Uniform{min, max};
  }

  std::optional<Distribution> ReadTriangular(const YAML::Node& body) {
    static const std::vector<std::string> keys{"min", "mode", "max"};
    if (!reader_.CheckKeys(body, "triangular of " + factor_.name, keys)) return std::nullopt;
    const auto min = Number(body, body["min"], "min");
    const auto mode = Number(body, body["mode"], "mode");
    const auto max = Number(body, body["max"], "max");
    if (!min || !mode || !max) return std::nullopt;
    if (*min >= *max || *mode < *min || *mode > *max) {
      return Fault<Distribution>(body, "needs min ≤ mode ≤ max and min < max");
    }
    return TriangularDistribution{*min, *mode, *max};
  }

  std::optional<Distribution> ReadNormal(const YAML::Node& body) {
    static const std::vector<std::string> keys{"mean", "sd", "min", "max"};
    if (!reader_.CheckKeys(body, "normal of " + factor_.name, keys)) return std::nullopt;
    const auto mean = Number(body, body["mean"], "mean");
    const auto sd = Number(body, body["sd"], "sd");
    std::optional<double> min = factor_.min;
    std::optional<double> max = factor_.max;
    if (body["min"].IsDefined()) min = Number(body, body["min"], "min");
    if (body["max"].IsDefined()) max = Number(body, body["max"], "max");
    if (!mean || !sd || !min || !max) return std::nullopt;
    if (*sd <= 0.0) return Fault<Distribution>(body["sd"], "needs an sd greater than 0");
    if (*min >= *max) return Fault<Distribution>(body, "needs a min less than its max");
    return Truncate({*mean, *sd, *min, *max}, body);
  }

  std::optional<Distribution> Truncate(const TruncatedNormalDistribution& normal,
                                       const YAML::Node& body) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double lost = 0.0;  // Beyond the ends that the study does not give.
    if (!body["min"].IsDefined())
      lost += NormalMass(normal.mean, normal.sd, -kInfinity, normal.min);
    if (!body["max"].IsDefined()) lost += NormalMass(normal.mean, normal.sd, normal.max, kInfinity);
    if (lost > kNegligibleMass) {
      return Fault<Distribution>(
          body, fmt::format("must stay from {:g} to {:g}, but {:.2g} % of this normal "
                            "distribution lies beyond: give min and max to truncate it",
                            factor_.min, factor_.max, 100.0 * lost));
    }
    if (NormalMass(normal.mean, normal.sd, normal.min, normal.max) < kLeastNormalMass) {
      return Fault<Distribution>(
          body, fmt::format("is cut to {:g} … {:g}, where next to nothing of this normal "
                            "distribution lies",
                            normal.min, normal.max));
    }
    return normal;
  }

  YamlReader& reader_;
  const ParameterInfo& factor_;
};

bool HasAnyOf(const YAML::Node& node, const std::vector<std::string>& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&node](const std::string& key) { return node[key].IsDefined(); });
}

}  // namespace

std::optional<std::variant<Levels, Distribution>> ReadFactorSetting(YamlReader& reader,
                                                                    const ParameterInfo& factor,
                                                                    const YAML::Node& node) {
  SettingReader setting(reader, factor);
  if (node.IsSequence()) return setting.ReadLevels(node);
  if (!node.IsMap()) {
    const auto value = factor.Read(reader, node);
    return value ? std::optional(Levels{*value}) : std::nullopt;
  }
  std::vector<std::string> keys = kRangeKeys;
  keys.insert(keys.end(), kDistributionKeys.begin(), kDistributionKeys.end());
  if (!reader.CheckKeys(node, factor.name, keys)) return std::nullopt;
  if (!HasAnyOf(node, kDistributionKeys)) return setting.ReadRange(node);
  if (node.size() != 1) {
    reader.AddFault(node, factor.name + " must be either one range or one distribution");
    return std::nullopt;
  }
  return setting.ReadDistribution(node, node.begin()->first.Scalar());
}

}  // namespace fenestra
