#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/parameter_table.h"
#include "core/io/yaml_reader.h"
#include "experiments/study/study.h"

namespace fenestra {

/// Reads what a study does with one factor; faults are noted in the reader. Accepted forms:
///
///   500                                              a fixed value
///   [1.4, 2, 3]                                      levels
///   {from: 0, to: 40, step: 10}                      levels, both ends included; the step must
///   {from: 0, to: 40, count: 5}                      divide the range
///   {uniform: [min, max]}                            drawn anew in every trial
///   {log_uniform: [min, max]}
///   {triangular: {min: 0, mode: 1, max: 3}}
///   {normal: {mean: 0, sd: 1, min: -2, max: 2}}      truncated; min and max may be left out
///
/// Every value that can occur lies in the factor's range. A normal distribution without a min or
/// max ends where the range ends if less than kNegligibleMass of it lies beyond; otherwise the
/// study must say where it ends.
std::optional<std::variant<Levels, Distribution>> ReadFactorSetting(YamlReader& reader,
                                                                    const ParameterInfo& factor,
                                                                    const YAML::Node& node);

/// The keys of the mappings above.
inline const std::vector<std::string> kRangeKeys{"from", "to", "step", "count"};
inline const std::vector<std::string> kDistributionKeys{"uniform", "log_uniform", "triangular",
                                                        "normal"};

/// So little probability may lie beyond a factor's range: a study of 10⁶ trials would draw one
/// value there.
inline constexpr double kNegligibleMass = 1e-6;

}  // namespace fenestra
