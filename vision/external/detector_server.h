#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <ostream>

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "vision/external/detector_protocol.h"

namespace fenestra {

/// The program's end of an ExternalDetector, for a detector that implements `Detector`.
struct ServedDetector {
  /// Returns why the options are refused; empty if they are accepted.
  std::function<std::string(const Hello&)> objection;
  std::function<std::unique_ptr<Detector>(const Hello&, const SensorCalibration&)> make;
};

/// Answers requests, one per line, until `in` ends. A new detector is made whenever the calibration
/// differs from that of the previous request. Exceptions of the detector become error answers.
/// Throws std::runtime_error for a line that is not a request.
void ServeDetector(const ServedDetector& served, std::istream& in, std::ostream& out);

}  // namespace fenestra
