#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/yaml_reader.h"

namespace fenestra {

/// What a detector must achieve at a level to be of use there: each demand says that a share of all
/// attempts is good. Over the attempts (target in view); a miss is never good.
struct Requirement {
  double hit_rate = 0.0;               ///< At least this share are hits; 0: not asked.
  std::optional<double> p50_error_mm;  ///< At least half have at most this error.
  std::optional<double> p95_error_mm;  ///< At least 95 % have.

  bool operator==(const Requirement&) const = default;
};

/// A search for the levels of one factor at which a requirement holds, for each combination of all
/// other levels.
struct EnvelopeRule {
  std::string over;  ///< A factor of the part with at least three levels, rising.
  Requirement require;
  double confidence = 0.95;

  bool operator==(const EnvelopeRule&) const = default;
};

/// Reads {over: distance_m, require: {hit_rate: 0.95, p95_error_mm: 50}, confidence: 0.95}; faults
/// are noted in the reader.
std::optional<EnvelopeRule> ReadEnvelopeRule(YamlReader& reader, const YAML::Node& node);

inline const std::vector<std::string> kEnvelopeKeys{"over", "require", "confidence"};
inline const std::vector<std::string> kRequirementKeys{"hit_rate", "p50_error_mm", "p95_error_mm"};

}  // namespace fenestra
