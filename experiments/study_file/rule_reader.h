#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/yaml_reader.h"
#include "experiments/study/envelope_rule.h"
#include "experiments/study/stopping_rule.h"

namespace fenestra {

/// Reads `{hit_rate: 0.1, p95_error_mm: 20, first_look: 30}`; faults are noted in the reader.
std::optional<StoppingRule> ReadStoppingRule(YamlReader& reader, const YAML::Node& node);

/// The keys of a rule: StoppingMetrics() and first_look.
const std::vector<std::string>& StoppingKeys();

/// Reads {over: distance_m, require: {hit_rate: 0.95, p95_error_mm: 50}, confidence: 0.95}; faults
/// are noted in the reader.
std::optional<EnvelopeRule> ReadEnvelopeRule(YamlReader& reader, const YAML::Node& node);

inline const std::vector<std::string> kEnvelopeKeys{"over", "require", "confidence"};

}  // namespace fenestra
