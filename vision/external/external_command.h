#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/observation.h"
#include "core/parameter_table.h"

namespace fenestra {

/// A detector that is a program of its own: how it is started and how long it may take.
struct ExternalCommand {
  /// The program, found along PATH unless it has a slash, and its arguments.
  std::vector<std::string> words;
  SensorKind sensor = SensorKind::kStereo;
  std::map<std::string, ParameterValue> options{};  ///< Handed to the program as they are.
  /// From handing over an observation to the answer. Ten times the 0.8 s that the slower of the
  /// paper's pipelines took.
  double time_limit_s = 8.0;
  /// From starting the program to its first word; loading libraries takes a script seconds.
  double start_limit_s = 20.0;

  bool operator==(const ExternalCommand&) const = default;
  /// For people: the words, joined.
  std::string Title() const;
};

}  // namespace fenestra
