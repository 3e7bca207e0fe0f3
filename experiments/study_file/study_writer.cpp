#include "experiments/study_file/study_writer.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/system/program.h"

namespace fenestra {
namespace {

using YAML::BeginMap;
using YAML::BeginSeq;
using YAML::Emitter;
using YAML::EndMap;
using YAML::EndSeq;
using YAML::Flow;

// The shortest form that reads back exactly, which the emitter's own is not.
std::string Shortest(double number) {
  return fmt::format("{}", number);
}

Emitter& operator<<(Emitter& yaml, const UniformDistribution& d) {
  return yaml << "uniform" << std::vector{Shortest(d.min), Shortest(d.max)};
}

Emitter& operator<<(Emitter& yaml, const LogUniformDistribution& d) {
  return yaml << "log_uniform" << std::vector{Shortest(d.min), Shortest(d.max)};
}

Emitter& operator<<(Emitter& yaml, const TriangularDistribution& d) {
  return yaml << "triangular" << BeginMap << "min" << Shortest(d.min) << "mode" << Shortest(d.mode)
              << "max" << Shortest(d.max) << EndMap;
}

Emitter& operator<<(Emitter& yaml, const TruncatedNormalDistribution& d) {
  return yaml << "normal" << BeginMap << "mean" << Shortest(d.mean) << "sd" << Shortest(d.sd)
              << "min" << Shortest(d.min) << "max" << Shortest(d.max) << EndMap;
}

void Write(Emitter& yaml, const Distribution& distribution) {
  yaml << Flow << BeginMap;
  std::visit([&yaml](const auto& d) { yaml << d; }, distribution);
  yaml << EndMap;
}

void Write(Emitter& yaml, const Levels& levels) {
  std::vector<std::string> words;
  for (const ParameterValue& level : levels) words.push_back(ToString(level));
  if (words.size() == 1) {
    yaml << words.front();
  } else {
    yaml << Flow << words;
  }
}

void Write(Emitter& yaml, const std::variant<Levels, Distribution>& setting) {
  std::visit([&yaml](const auto& s) { Write(yaml, s); }, setting);
}

Emitter& operator<<(Emitter& yaml, const DetectorChoice& detector) {
  yaml << BeginMap << "name" << detector.name << "label" << detector.label;
  const auto& process = detector.process;
  const bool has_command = process && !process->command.empty();
  if (has_command) {
    yaml << "command" << Flow << BeginSeq;
    for (const std::string& word : process->command) yaml << YAML::DoubleQuoted << word;
    yaml << EndSeq << "sensor" << ToString(detector.sensor);
  } else {
    yaml << "isolate" << process.has_value();
  }
  if (process) {
    yaml << "time_limit_s" << Shortest(process->time_limit_s);
    yaml << "start_limit_s" << Shortest(process->start_limit_s);
  }
  yaml << "options";
  if (detector.options.empty()) yaml << Flow;
  yaml << BeginMap;
  for (const auto& [option, value] : detector.options) {
    yaml << option;
    if (has_command && std::holds_alternative<std::string>(value)) yaml << YAML::DoubleQuoted;
    yaml << ToString(value);
  }
  return yaml << EndMap << EndMap;
}

Emitter& operator<<(Emitter& yaml, const SamplingDesign& design) {
  yaml << BeginMap << "method" << ToString(design.method);
  if (!design.correlations.empty()) yaml << "correlations" << BeginSeq;
  for (const FactorCorrelation& c : design.correlations) {
    yaml << Flow << BeginMap << "between" << std::vector{c.first, c.second} << "spearman"
         << Shortest(c.spearman) << EndMap;
  }
  if (!design.correlations.empty()) yaml << EndSeq;
  if (!design.causes.empty()) yaml << "causes" << BeginMap;
  for (const Cause& cause : design.causes) yaml << cause.name << Flow << cause.sources;
  if (!design.causes.empty()) yaml << EndMap;
  return yaml << EndMap;
}

Emitter& operator<<(Emitter& yaml, const StoppingRule& rule) {
  yaml << BeginMap << "first_look" << rule.first_look;
  for (const auto& [metric, width] : rule.targets) yaml << metric << Shortest(width);
  return yaml << EndMap;
}

Emitter& operator<<(Emitter& yaml, const EnvelopeRule& rule) {
  yaml << BeginMap << "over" << rule.over << "confidence" << Shortest(rule.confidence);
  yaml << "require" << BeginMap;
  for (const auto& [metric, value] : rule.require) yaml << metric << Shortest(value);
  return yaml << EndMap << EndMap;
}

Emitter& operator<<(Emitter& yaml, const StudyPart& part) {
  yaml << BeginMap << "name" << part.name << "repetitions" << part.repetitions;
  yaml << "sensors" << Flow << BeginSeq;
  for (const SensorKind sensor : part.sensors) yaml << ToString(sensor);
  yaml << EndSeq << "design" << part.design;
  if (part.until) yaml << "until" << *part.until;
  if (part.envelope) yaml << "envelope" << *part.envelope;
  yaml << "detectors" << BeginSeq;
  for (const DetectorChoice& detector : part.detectors) yaml << detector;
  yaml << EndSeq << "factors" << BeginMap;
  for (const Factor& factor : part.factors) {
    yaml << factor.name;
    Write(yaml, factor.setting);
  }
  return yaml << EndMap << EndMap;
}

}  // namespace

std::string ToYaml(const std::variant<Levels, Distribution>& setting) {
  Emitter yaml;
  Write(yaml, setting);
  return yaml.c_str();
}

std::string ToYaml(const Study& study) {
  Emitter yaml;
  yaml << BeginMap << "fenestra_version" << Version() << "name" << study.name;
  yaml << "description" << YAML::DoubleQuoted << study.description << "seed" << study.seed;
  yaml << "independent_cells" << study.independent_cells << "parts" << BeginSeq;
  for (const StudyPart& part : study.parts) yaml << part;
  yaml << EndSeq << EndMap;
  return std::string(yaml.c_str()) + "\n";
}

}  // namespace fenestra
