#include "experiments/study_file/design_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/io/faults.h"
#include "experiments/sampling/causes.h"
#include "experiments/sampling/gaussian_copula.h"
#include "experiments/study_file/detector_reader.h"

namespace fenestra {
namespace {

constexpr double kLargestCorrelation = 0.999;

std::optional<DesignMethod> ReadMethod(YamlReader& reader, const YAML::Node& node) {
  const auto word = reader.Text(node, "a design's method");
  if (!word) return std::nullopt;
  const auto method = ParseDesignMethod(*word);
  if (method) return method;
  std::vector<std::string> names;
  for (const DesignMethod known : kAllDesignMethods) names.push_back(ToString(known));
  reader.AddFault(node, fmt::format("unknown design '{}'.{} Known: {}.", *word,
                                    DidYouMean(*word, names), fmt::join(names, ", ")));
  return std::nullopt;
}

std::optional<std::string> ReadFactorName(YamlReader& reader, const YAML::Node& node,
                                          const std::vector<std::string>& also) {
  auto name = reader.Text(node, "a factor's name");
  if (!name) return std::nullopt;
  std::vector<std::string> names = also;
  const std::vector<std::string> factors = Factors().Names();
  names.insert(names.end(), factors.begin(), factors.end());
  if (std::find(names.begin(), names.end(), *name) != names.end()) return name;
  reader.AddFault(node, fmt::format("unknown factor '{}'.{}", *name, DidYouMean(*name, names)));
  return std::nullopt;
}

std::optional<FactorCorrelation> ReadCorrelation(YamlReader& reader, const YAML::Node& node) {
  if (!reader.CheckKeys(node, "a correlation", kCorrelationKeys)) return std::nullopt;
  const YAML::Node between = node["between"];
  const YAML::Node spearman = node["spearman"];
  if (!between.IsDefined() || !spearman.IsDefined() || !between.IsSequence() ||
      between.size() != 2) {
    reader.AddFault(node, "a correlation must be {between: [FACTOR, FACTOR], spearman: NUMBER}");
    return std::nullopt;
  }
  const auto first = ReadFactorName(reader, between[0], {});
  const auto second = ReadFactorName(reader, between[1], {});
  const auto value = reader.Number(spearman, "spearman");
  if (!first || !second || !value) return std::nullopt;
  if (*first == *second) {
    reader.AddFault(between, fmt::format("{} cannot be correlated with itself", *first));
    return std::nullopt;
  }
  if (!(std::abs(*value) <= kLargestCorrelation)) {
    reader.AddFault(spearman, fmt::format("spearman must be a number from {:g} to {:g}, not {:g}",
                                          -kLargestCorrelation, kLargestCorrelation, *value));
    return std::nullopt;
  }
  return FactorCorrelation{*first, *second, *value};
}

// Reads a design that is a mapping.
class DesignReader {
 public:
  explicit DesignReader(YamlReader& reader) : reader_(reader) {}

  std::optional<GivenDesign> Read(const YAML::Node& node) {
    given_.node = node;
    const size_t before = reader_.fault_count();
    reader_.CheckKeys(node, "a design", kDesignKeys);
    if (!node.IsMap()) return std::nullopt;
    if (const YAML::Node word = node["method"]; word.IsDefined()) {
      given_.design.method = ReadMethod(reader_, word).value_or(given_.design.method);
    }
    if (const YAML::Node list = node["correlations"]; list.IsDefined()) ReadCorrelations(list);
    if (const YAML::Node causes = node["causes"]; causes.IsDefined()) ReadCauses(causes);
    if (reader_.fault_count() == before) CheckTogether();
    return reader_.IfSoundSince(before, given_);
  }

 private:
  void ReadCorrelations(const YAML::Node& node) {
    if (!node.IsSequence()) {
      return reader_.AddFault(
          node, fmt::format("correlations must be a list of {{between: [FACTOR, FACTOR], "
                            "spearman: NUMBER}}, not {}",
                            YamlReader::Describe(node)));
    }
    for (const YAML::Node& item : node) {
      const auto correlation = ReadCorrelation(reader_, item);
      if (!correlation) continue;
      if (!pairs_.insert({correlation->first, correlation->second}).second) {
        reader_.AddFault(item, fmt::format("{} and {} are correlated twice", correlation->first,
                                           correlation->second));
      }
      given_.design.correlations.push_back(*correlation);
      given_.correlation_nodes.push_back(item);
    }
  }

  void ReadCauses(const YAML::Node& node) {
    if (!node.IsMap() || node.size() == 0) {
      return reader_.AddFault(node,
                              fmt::format("causes must be a mapping such as {{noise: [shot], pose: "
                                          "[yaw_deg]}}, not {}",
                                          YamlReader::Describe(node)));
    }
    given_.causes_node = node;
    for (const auto& entry : node) ReadCause(entry.first, entry.second);
  }

  void ReadCause(const YAML::Node& key, const YAML::Node& node) {
    static const std::vector<std::string> streams{kShotSource, kRigSource, kCalibrationSource};
    const auto name = ReadName(reader_, key, "a cause's name");
    if (!name) return;
    if (!node.IsSequence() || node.size() == 0) {
      return reader_.AddFault(
          key, fmt::format("cause '{}' must be a list of drawn factors and of {}", *name,
                           fmt::join(streams, ", ")));
    }
    const auto is_it = [&name](const Cause& cause) { return cause.name == *name; };
    if (std::any_of(given_.design.causes.begin(), given_.design.causes.end(), is_it)) {
      return reader_.AddFault(key, fmt::format("two causes are called '{}'", *name));
    }
    Cause cause{.name = *name, .sources = {}};
    for (const YAML::Node& item : node) {
      const auto source = ReadFactorName(reader_, item, streams);
      if (!source) return;
      if (!sources_.insert(*source).second) {
        return reader_.AddFault(item, fmt::format("'{}' belongs to two causes", *source));
      }
      cause.sources.push_back(*source);
    }
    given_.design.causes.push_back(cause);
  }

  void CheckTogether() {
    const bool sensitivity = given_.design.method == DesignMethod::kSensitivity;
    if (sensitivity && !given_.design.correlations.empty()) {
      reader_.AddFault(
          given_.correlation_nodes.front(),
          "a sensitivity design cannot have correlations: the shares of a variance are "
          "only defined for causes that are independent of each other");
    }
    if (!sensitivity && !given_.design.causes.empty()) {
      reader_.AddFault(given_.causes_node,
                       fmt::format("causes belong to method: sensitivity, not {}",
                                   ToString(given_.design.method)));
    }
  }

  YamlReader& reader_;
  GivenDesign given_;
  std::set<std::set<std::string>> pairs_;
  std::set<std::string> sources_;
};

std::vector<FactorCorrelation> ResolveCorrelations(YamlReader& reader, const GivenDesign& given,
                                                   const StudyPart& part, bool own) {
  std::vector<FactorCorrelation> resolved;
  const std::vector<std::string> sources = SourcesOf(part);
  const auto drawn = [&sources](const std::string& name) {
    return std::find(sources.begin(), sources.end(), name) != sources.end();
  };
  for (size_t i = 0; i < given.design.correlations.size(); ++i) {
    const FactorCorrelation& correlation = given.design.correlations[i];
    bool effective = true;
    for (const std::string& name : {correlation.first, correlation.second}) {
      if (drawn(name)) continue;
      effective = false;
      if (!own) continue;
      reader.AddFault(given.correlation_nodes[i],
                      fmt::format("{} cannot be correlated: part '{}' does not draw it from a "
                                  "distribution",
                                  name, part.name));
    }
    if (effective) resolved.push_back(correlation);
  }
  if (!GaussianCopula::Of(sources, resolved)) {
    reader.AddFault(given.node, fmt::format("no joint distribution has the correlations of part "
                                            "'{}': they contradict each other",
                                            part.name));
  }
  return resolved;
}

std::vector<Cause> ResolveCauses(YamlReader& reader, const GivenDesign& given,
                                 const StudyPart& part, bool own) {
  if (given.design.causes.empty()) return DefaultCauses(part);
  std::vector<Cause> resolved;
  const std::vector<std::string> sources = SourcesOf(part);
  std::set<std::string> without_cause(sources.begin(), sources.end());
  for (Cause cause : given.design.causes) {
    std::erase_if(cause.sources, [&](const std::string& source) {
      if (without_cause.erase(source) == 1) return false;
      if (own) {
        reader.AddFault(given.causes_node, fmt::format("'{}' of cause '{}' does not vary in part "
                                                       "'{}'",
                                                       source, cause.name, part.name));
      }
      return true;
    });
    if (!cause.sources.empty()) resolved.push_back(std::move(cause));
  }
  if (!without_cause.empty()) {
    reader.AddFault(given.causes_node,
                    fmt::format("of all that varies in part '{}', these belong to no cause: {}",
                                part.name, fmt::join(without_cause, ", ")));
  }
  return resolved;
}

}  // namespace

std::optional<GivenDesign> ReadDesign(YamlReader& reader, const YAML::Node& node) {
  GivenDesign given;
  given.node = node;
  if (node.IsScalar()) {
    const auto method = ReadMethod(reader, node);
    if (!method) return std::nullopt;
    given.design.method = *method;
    return given;
  }
  return DesignReader(reader).Read(node);
}

SamplingDesign ResolveDesign(YamlReader& reader, const GivenDesign& given, const StudyPart& part,
                             bool own) {
  SamplingDesign design{.method = given.design.method,
                        .correlations = ResolveCorrelations(reader, given, part, own),
                        .causes = {}};
  if (design.method == DesignMethod::kSensitivity) {
    design.causes = ResolveCauses(reader, given, part, own);
  }
  return design;
}

}  // namespace fenestra
