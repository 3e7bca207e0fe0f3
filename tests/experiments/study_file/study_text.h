#pragma once

#include <string>
#include <vector>

#include "core/io/input_error.h"
#include "core/io/yaml_reader.h"
#include "experiments/study_file/study_reader.h"

namespace fenestra {

/// Stand-ins for the registered detectors, so that tests of studies do not depend on their
/// options: paper-stereo, other-stereo and paper-rgbd.
inline std::vector<DetectorInfo> StandInDetectors() {
  using Type = ParameterInfo::Type;
  const ParameterInfo window{.name = "window_px",
                             .description = "",
                             .type = Type::kInteger,
                             .min = 5,
                             .max = 31,
                             .choices = {},
                             .default_value = 15.0};
  const ParameterInfo ratio{.name = "ratio",
                            .description = "",
                            .type = Type::kNumber,
                            .min = 0,
                            .max = 1,
                            .choices = {},
                            .default_value = 0.1};
  const ParameterInfo prior{.name = "prior",
                            .description = "",
                            .type = Type::kSwitch,
                            .choices = {},
                            .default_value = false};
  const ParameterInfo matcher{.name = "matcher",
                              .description = "",
                              .type = Type::kChoice,
                              .choices = {"sad", "census"},
                              .default_value = std::string("sad")};
  return {{"paper-stereo", SensorKind::kStereo, "", {window, matcher}},
          {"other-stereo", SensorKind::kStereo, "", {}},
          {"paper-rgbd", SensorKind::kRgbd, "", {ratio, prior}}};
}

inline Study ReadText(const std::string& text) {
  static const std::vector<DetectorInfo> known = StandInDetectors();
  return ReadStudy(YamlReader::FromText(text, "study.yaml"), known);
}

/// The faults of a study as "line:column: message"; empty for a sound one.
inline std::vector<std::string> FaultsOf(const std::string& text) {
  std::vector<std::string> lines;
  try {
    ReadText(text);
  } catch (const InputError& error) {
    for (InputFault fault : error.faults()) {
      fault.source.clear();
      std::string line = fault.ToString();
      lines.push_back(line.starts_with(":") ? line.substr(1) : line);
    }
  }
  return lines;
}

}  // namespace fenestra
