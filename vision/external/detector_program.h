#pragma once

#include "core/calibration.h"
#include "core/private_folder.h"
#include "vision/external/child_process.h"
#include "vision/external/detector_protocol.h"
#include "vision/external/external_command.h"

namespace fenestra {

/// A detector's program that is running and has said hello. It is handed one observation at a time,
/// as files in a folder of its own that hold what a detector may see and nothing else.
class DetectorProgram {
 public:
  /// Throws InputError if the program cannot be started, does not say hello in time, speaks another
  /// protocol or refuses its options.
  explicit DetectorProgram(const ExternalCommand& command);

  /// An answer that names no stages gets one, "answer": the time from the request to it.
  /// Throws DetectorFailure: what ParseDetectAnswer throws, or "timeout", "died", "flood". After
  /// any but "exception" the program has been stopped.
  TimedDetection Ask(const Observation& observation, const SensorCalibration& calibration);

  bool running() const { return running_; }

 private:
  /// The answer, or a DetectorFailure that says how the program ended.
  std::string Talk(const std::string& request, double limit_s);
  /// With paths that are never the same twice written as those of `.`.
  std::string Told(const std::string& detail) const;

  ExternalCommand command_;
  PrivateFolder folder_;
  ChildProcess process_;
  int64_t last_id_ = 0;
  bool running_ = true;
};

}  // namespace fenestra
