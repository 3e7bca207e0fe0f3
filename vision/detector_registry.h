#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vision/detector_info.h"

namespace fenestra {

/// Returns all detectors in the order in which lists show them.
const std::vector<DetectorInfo>& Detectors();

/// Adds a detector that is not built in, for plugin_loader.h and for programs that link this
/// library. Call it before detectors are used, from one thread. Throws InputError if the name is
/// taken or is not a detector name (IsDetectorName).
void RegisterDetector(const DetectorInfo& info, const DetectorFactory& make);

/// Tells whether a name consists of 1 to 64 of the characters a-z 0-9 _ -, since names become
/// labels, folder names and table columns.
bool IsDetectorName(const std::string& name);

/// Returns nullptr if there is no detector of that name.
const DetectorInfo* FindDetector(const std::string& name);

/// Makes a detector, which must exist. Its sensor must be that of the calibration, and its options
/// must be valid. Throws InputError for options that contradict each other.
std::unique_ptr<Detector> MakeDetector(const std::string& name,
                                       const SensorCalibration& calibration,
                                       const OptionValues& options);

}  // namespace fenestra
