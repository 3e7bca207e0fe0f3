#pragma once

#include <string>

#include "core/io/yaml_reader.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// Reads what was surveyed of a frame (see sequence.h); faults are noted in the reader.
GroundTruth ReadSurveyedTruth(YamlReader& reader, const YAML::Node& node);

/// The same as YAML, on one line.
std::string ToYaml(const GroundTruth& truth);

}  // namespace fenestra
