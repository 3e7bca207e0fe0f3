#pragma once

#include <filesystem>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"

namespace fenestra {

/// Where one observation and its calibration are, a file each:
///
///     left.png, right.png, calibration.yaml      (stereo; 8-bit grey)
///     color.png, depth.png, calibration.yaml     (RGB-D; 8-bit colour, 16-bit depth, 0: no return)
struct ObservationFiles {
  SensorKind sensor = SensorKind::kStereo;
  std::filesystem::path left, right;   ///< Stereo.
  std::filesystem::path color, depth;  ///< RGB-D.
  std::filesystem::path calibration;

  /// With the names above.
  static ObservationFiles In(const std::filesystem::path& folder, SensorKind sensor);
};

/// Writes an observation and its calibration alone, without loss, under the names above.
void WriteObservation(const std::filesystem::path& folder, const Observation& observation,
                      const SensorCalibration& calibration);

struct RecordedObservation {
  Observation observation;
  SensorCalibration calibration;
};

/// Throws InputError for a file that is missing, damaged or of another kind.
RecordedObservation ReadObservation(const ObservationFiles& files);

}  // namespace fenestra
