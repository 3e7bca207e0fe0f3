#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <ostream>

#include "core/calibration.h"
#include "core/detector.h"
#include "vision/external/detector_protocol.h"

namespace fenestra {

/// The other end of an ExternalDetector, for a detector that is written against `Detector`.
struct ServedDetector {
  /// Why options are refused; empty if they are not.
  std::function<std::string(const Hello&)> objection;
  std::function<std::unique_ptr<Detector>(const Hello&, const SensorCalibration&)> make;
};

/// Answers requests, a line each, until `in` ends. The detector is made anew where the calibration
/// differs from that of the request before. What it throws becomes an error answer. Throws
/// std::runtime_error for a line that is no request.
void ServeDetector(const ServedDetector& served, std::istream& in, std::ostream& out);

}  // namespace fenestra
