#include "experiments/study_file/study_writer.h"

#include <fmt/format.h>

#include "core/io/yaml_reader.h"
#include "core/system/program.h"

namespace fenestra {
namespace {

std::string Text(const UniformDistribution& d) {
  return fmt::format("{{uniform: [{}, {}]}}", d.min, d.max);
}

std::string Text(const LogUniformDistribution& d) {
  return fmt::format("{{log_uniform: [{}, {}]}}", d.min, d.max);
}

std::string Text(const TriangularDistribution& d) {
  return fmt::format("{{triangular: {{min: {}, mode: {}, max: {}}}}}", d.min, d.mode, d.max);
}

std::string Text(const TruncatedNormalDistribution& d) {
  return fmt::format("{{normal: {{mean: {}, sd: {}, min: {}, max: {}}}}}", d.mean, d.sd, d.min,
                     d.max);
}

std::string Text(const Distribution& distribution) {
  return std::visit([](const auto& d) { return Text(d); }, distribution);
}

std::string Text(const Levels& levels) {
  if (levels.size() == 1) return ToString(levels.front());
  std::string text;
  for (const ParameterValue& level : levels) text += (text.empty() ? "" : ", ") + ToString(level);
  return "[" + text + "]";
}

std::string Text(const DetectorProcess& process, SensorKind sensor) {
  std::string text;
  if (process.command.empty()) {
    text = "        isolate: true\n";
  } else {
    std::string words;
    for (const std::string& word : process.command) {
      words += (words.empty() ? "" : ", ") + YamlQuoted(word);
    }
    text = fmt::format("        command: [{}]\n        sensor: {}\n", words, ToString(sensor));
  }
  return text + fmt::format("        time_limit_s: {}\n        start_limit_s: {}\n",
                            process.time_limit_s, process.start_limit_s);
}

std::string Text(const DetectorChoice& detector) {
  std::string text =
      fmt::format("      - name: {}\n        label: {}\n", detector.name, detector.label);
  text += detector.process ? Text(*detector.process, detector.sensor) : "        isolate: false\n";
  text += detector.options.empty() ? "        options: {}\n" : "        options:\n";
  const bool quoted = detector.process && !detector.process->command.empty();
  for (const auto& [option, value] : detector.options) {
    const std::string* word = std::get_if<std::string>(&value);
    text += fmt::format("          {}: {}\n", option,
                        quoted && word != nullptr ? YamlQuoted(*word) : ToString(value));
  }
  return text;
}

std::string Text(const SamplingDesign& design) {
  std::string text = fmt::format("    design:\n      method: {}\n", ToString(design.method));
  if (!design.correlations.empty()) text += "      correlations:\n";
  for (const FactorCorrelation& c : design.correlations) {
    text += fmt::format("        - {{between: [{}, {}], spearman: {}}}\n", c.first, c.second,
                        c.spearman);
  }
  if (!design.causes.empty()) text += "      causes:\n";
  for (const Cause& cause : design.causes) {
    text += fmt::format("        {}: [{}]\n", cause.name, fmt::join(cause.sources, ", "));
  }
  return text;
}

std::string Text(const StoppingRule& rule) {
  std::string text = fmt::format("    until:\n      first_look: {}\n", rule.first_look);
  for (const auto& [metric, width] : rule.targets) {
    text += fmt::format("      {}: {}\n", metric, width);
  }
  return text;
}

std::string Text(const EnvelopeRule& rule) {
  std::string text =
      fmt::format("    envelope:\n      over: {}\n      confidence: {}\n      require:\n",
                  rule.over, rule.confidence);
  for (const auto& [metric, value] : rule.require) {
    text += fmt::format("        {}: {}\n", metric, value);
  }
  return text;
}

std::string Text(const StudyPart& part) {
  std::string sensors;
  for (const SensorKind sensor : part.sensors) {
    sensors += (sensors.empty() ? "" : ", ") + std::string(ToString(sensor));
  }
  std::string text = fmt::format("  - name: {}\n    repetitions: {}\n    sensors: [{}]\n",
                                 part.name, part.repetitions, sensors);
  text += Text(part.design);
  if (part.until) text += Text(*part.until);
  if (part.envelope) text += Text(*part.envelope);
  text += "    detectors:\n";
  for (const DetectorChoice& detector : part.detectors) text += Text(detector);
  text += "    factors:\n";
  for (const Factor& factor : part.factors) {
    text += fmt::format("      {}: {}\n", factor.name, ToYaml(factor.setting));
  }
  return text;
}

}  // namespace

std::string ToYaml(const std::variant<Levels, Distribution>& setting) {
  return std::visit([](const auto& s) { return Text(s); }, setting);
}

std::string ToYaml(const Study& study) {
  std::string text = fmt::format(
      "fenestra_version: {}\nname: {}\ndescription: {}\nseed: {}\nindependent_cells: {}\nparts:\n",
      Version(), study.name, YamlQuoted(study.description), study.seed, study.independent_cells);
  for (const StudyPart& part : study.parts) text += Text(part);
  return text;
}

}  // namespace fenestra
