#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vision/detector_info.h"

namespace fenestra {

/// All detectors, in the order in which lists show them.
const std::vector<DetectorInfo>& Detectors();

/// Adds a detector of another's own (plugin_loader.h does, and so may a program that links this
/// library). Call it before detectors are used, from one thread. Throws InputError if the name is
/// taken or none (IsDetectorName).
void RegisterDetector(const DetectorInfo& info, const DetectorFactory& make);

/// 1 to 64 of the characters a-z 0-9 _ -: names become labels, folder names and table columns.
bool IsDetectorName(const std::string& name);

/// nullptr if there is no detector of that name.
const DetectorInfo* FindDetector(const std::string& name);

/// The detector must exist; its sensor must be that of the calibration and its options must be
/// allowed. Throws InputError for options that contradict each other.
std::unique_ptr<Detector> MakeDetector(const std::string& name,
                                       const SensorCalibration& calibration,
                                       const OptionValues& options);

}  // namespace fenestra
