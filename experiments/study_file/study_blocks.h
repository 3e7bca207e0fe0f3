#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/io/yaml_reader.h"
#include "experiments/study/study.h"
#include "experiments/study_file/design_reader.h"
#include "experiments/study_file/detector_reader.h"

namespace fenestra {

/// A factor as a study file gives it, and where.
struct GivenFactor {
  Factor factor;
  YAML::Node key;
};

/// The keys that a study and each of its parts have in common; absent where the file has none.
struct StudyBlock {
  YAML::Node node;
  std::optional<std::vector<SensorKind>> sensors;
  std::optional<std::vector<GivenDetector>> detectors;
  std::vector<GivenFactor> factors;
  std::optional<int> repetitions;
  std::optional<GivenDesign> design;
  std::optional<StoppingRule> until;
  std::optional<EnvelopeRule> envelope;
  /// Whether the block was read without faults. Otherwise a missing key may merely be misspelt.
  bool sound = true;

  const GivenFactor* FindFactor(const std::string& name) const;
};

/// The keys that ReadBlock reads.
const std::vector<std::string>& BlockKeys();
/// These keys and, behind them, BlockKeys.
std::vector<std::string> WithBlockKeys(std::vector<std::string> keys);

/// Reads the keys in BlockKeys of a mapping; faults are noted in the reader.
StudyBlock ReadBlock(YamlReader& reader, const YAML::Node& node,
                     std::span<const DetectorInfo> known_detectors);

}  // namespace fenestra
