#pragma once

#include <optional>
#include <string>

#include "core/detection/observation.h"
#include "core/io/yaml_reader.h"

namespace fenestra {

/// Reads "stereo" or "rgbd".
std::optional<SensorKind> ReadSensor(YamlReader& reader, const YAML::Node& node);

/// Names of studies, parts and labels become folder names and table columns: [a-z0-9_-], at most
/// 64 of them.
std::optional<std::string> ReadName(YamlReader& reader, const YAML::Node& node,
                                    const std::string& what);

}  // namespace fenestra
