#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/detection/observation.h"
#include "core/io/yaml_reader.h"
#include "experiments/study/study.h"
#include "vision/detector_registry.h"

namespace fenestra {

/// A detector that a study names, and where.
struct GivenDetector {
  DetectorChoice choice;
  YAML::Node node;
};

/// The keys of a detector of this program.
inline const std::vector<std::string> kDetectorKeys{"name",    "label",        "options",
                                                    "isolate", "time_limit_s", "start_limit_s"};

inline const std::vector<std::string> kProgramKeys{
    "name", "label", "command", "sensor", "options", "time_limit_s", "start_limit_s"};
/// No time limit may be longer.
inline constexpr double kLongestLimit_s = 3600.0;

/// Reads a list of detectors, each a name or {name: …, label: …, options: {…}, isolate: …}, or a
/// program of the user's own:
///
///     name: mine                     # and its label, unless that is given, too
///     command: [python3, mine.py]    # found along PATH; relative to where fenestra is started
///     sensor: stereo                 # or rgbd
///     options: {size_m: 0.8}         # optional: switches, numbers and texts, handed over
///     time_limit_s: 8                # optional: for an answer
///     start_limit_s: 20              # optional: for the first one
///
/// Options that are not given have their defaults, a missing label is the name. Faults are noted in
/// the reader; the result is nullopt if there are any.
std::optional<std::vector<GivenDetector>> ReadDetectors(YamlReader& reader, const YAML::Node& node,
                                                        std::span<const DetectorInfo> known);

/// Reads a program's command, a list of words; faults are noted in the reader.
std::vector<std::string> ReadCommand(YamlReader& reader, const YAML::Node& node);

/// Reads the value of a program's option: true and false are switches, numbers are numbers, and
/// everything else, as well as everything in quotes, is text.
std::optional<ParameterValue> ReadFreeValue(YamlReader& reader, const YAML::Node& node,
                                            const std::string& name);

/// Reads "stereo" or "rgbd".
std::optional<SensorKind> ReadSensor(YamlReader& reader, const YAML::Node& node);

/// Names of studies, parts and labels become folder names and table columns: [a-z0-9_-], at most
/// 64 of them.
std::optional<std::string> ReadName(YamlReader& reader, const YAML::Node& node,
                                    const std::string& what);

}  // namespace fenestra
