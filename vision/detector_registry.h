#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/calibration.h"
#include "core/detector.h"
#include "core/parameter_table.h"

namespace fenestra {

/// A detector that can be asked for by name.
struct DetectorInfo {
  std::string name;  ///< "paper-stereo"
  SensorKind sensor;
  std::string description;  ///< One line.
  std::vector<ParameterInfo> options;
};

using OptionValues = std::map<std::string, ParameterValue>;

/// All detectors, in the order in which lists show them.
const std::vector<DetectorInfo>& Detectors();

/// nullptr if there is no detector of that name.
const DetectorInfo* FindDetector(const std::string& name);

/// The detector must exist; its sensor must be that of the calibration and its options must be
/// allowed. Throws InputError for options that contradict each other.
std::unique_ptr<Detector> MakeDetector(const std::string& name,
                                       const SensorCalibration& calibration,
                                       const OptionValues& options);

}  // namespace fenestra
