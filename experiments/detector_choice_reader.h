#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/yaml_reader.h"
#include "experiments/study.h"
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

/// Reads a list of detectors, each a name or {name: …, label: …, options: {…}, isolate: …}, or a
/// program of the user's own (see detector_process_reader.h); options that are not given have their
/// defaults, a missing label is the name. Faults are noted in the reader; the
/// result is nullopt if there are any.
std::optional<std::vector<GivenDetector>> ReadDetectors(YamlReader& reader, const YAML::Node& node,
                                                        std::span<const DetectorInfo> known);

/// The detector with all its options at their defaults.
DetectorChoice DefaultChoice(const DetectorInfo& detector);

/// Names of studies, parts and labels become folder names and table columns: [a-z0-9_-], at most
/// 64 of them.
std::optional<std::string> ReadName(YamlReader& reader, const YAML::Node& node,
                                    const std::string& what);

}  // namespace fenestra
