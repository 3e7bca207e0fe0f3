#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/yaml_reader.h"
#include "experiments/study/sampling_design.h"
#include "experiments/study/study.h"

namespace fenestra {

/// A design as a study file gives it, and where.
// NOLINTNEXTLINE(bugprone-exception-escape): nodes are moved by copying shared pointers.
struct GivenDesign {
  SamplingDesign design;
  YAML::Node node;
  std::vector<YAML::Node> correlation_nodes;  ///< One for each correlation.
  YAML::Node causes_node;
};

/// Reads a design; faults are noted in the reader. Accepted forms:
///
///   sobol                                                 a method, independent factors
///   {method: latin_hypercube,
///    correlations: [{between: [azimuth_deg, yaw_deg], spearman: -0.8}]}
///   {method: sensitivity,
///    causes: {noise: [shot], calibration: [rig, calibration], pose: [yaw_deg, pitch_deg]}}
///
/// The method is monte_carlo unless given. Causes are those of DefaultCauses unless given.
std::optional<GivenDesign> ReadDesign(YamlReader& reader, const YAML::Node& node);

inline const std::vector<std::string> kDesignKeys{"method", "correlations", "causes"};
inline const std::vector<std::string> kCorrelationKeys{"between", "spearman"};

/// The design as far as it concerns the part, with its causes written out. `own`: the part itself
/// gave it, so that all of it must concern the part, which a study's design need not. Notes a fault
/// where correlations contradict each other and where something varies without a cause.
SamplingDesign ResolveDesign(YamlReader& reader, const GivenDesign& given, const StudyPart& part,
                             bool own);

}  // namespace fenestra
