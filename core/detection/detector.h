#pragma once

#include <stdexcept>
#include <string>

#include "core/detection/detection.h"
#include "core/detection/observation.h"
#include "core/detection/stage_log.h"

namespace fenestra {

/// Thrown by a detector that can give neither an estimate nor a Miss and knows a name for why. It
/// costs the detector this observation.
class DetectorFailure : public std::runtime_error {
 public:
  /// `kind` is a stable identifier in snake_case, such as "timeout"; `detail` is for people.
  DetectorFailure(std::string kind, const std::string& detail)
      : std::runtime_error(detail), kind_(std::move(kind)) {}

  const std::string& kind() const { return kind_; }

 private:
  std::string kind_;
};

/// The interface under test. A detector is built once from a nominal calibration and its options
/// and then sees one observation after the other; it must not remember anything between them.
class Detector {
 public:
  virtual ~Detector() = default;

  virtual SensorKind sensor() const = 0;

  /// Finds the window in an observation of this detector's sensor kind, or says why not.
  /// Thread-safe. Throws InputError for an observation that does not fit the calibration
  /// (image sizes) or is of the other sensor kind.
  virtual Detection Detect(const Observation& observation, StageLog& log) const = 0;
};

}  // namespace fenestra
