#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/detection/observation.h"
#include "core/io/parameter_table.h"

namespace fenestra {

/// Command line and time limits of a detector that is a separate program.
struct ExternalCommand {
  /// The program, found along PATH unless it has a slash, and its arguments.
  std::vector<std::string> words;
  SensorKind sensor = SensorKind::kStereo;
  std::map<std::string, ParameterValue> options{};  ///< Passed to the program unchanged.
  /// Time limit from the request to the answer: ten times the 0.8 s that the slower of the paper's
  /// pipelines took.
  double time_limit_s = 8.0;
  /// Time limit from the start of the program to its first answer; loading libraries takes a script
  /// seconds.
  double start_limit_s = 20.0;

  bool operator==(const ExternalCommand&) const = default;
  /// The command line, for people.
  std::string Title() const;
};

}  // namespace fenestra
