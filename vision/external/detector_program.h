#pragma once

#include "core/geometry/calibration.h"
#include "core/io/temporary_files.h"
#include "vision/external/child_process.h"
#include "vision/external/detector_protocol.h"
#include "vision/external/external_command.h"

namespace fenestra {

/// A detector's program that is running and has answered the hello request. It receives one
/// observation at a time, as files in a folder of its own that contain what a detector may see and
/// nothing else.
class DetectorProgram {
 public:
  /// Throws InputError if the program cannot be started, does not answer the hello request in time,
  /// uses another protocol version or refuses its options; SystemError if the machine has no folder,
  /// pipe or process left for it.
  explicit DetectorProgram(const ExternalCommand& command);

  /// Sends an observation and returns the program's answer. An answer without stages is given one,
  /// "answer", with the time since the request. Throws DetectorFailure as ParseDetectAnswer does,
  /// or with "timeout", "died" or "flood". After any failure but "exception" the program has been
  /// stopped. Throws SystemError if the observation could not be handed over or has been removed by
  /// others meanwhile: the program could not know better.
  TimedDetection Ask(const Observation& observation, const SensorCalibration& calibration);

  bool running() const { return running_; }

 private:
  /// Writes the files that the program may see.
  ObservationFiles Hand(const Observation& observation, const SensorCalibration& calibration) const;
  void RequireThere(const ObservationFiles& files) const;
  TimedDetection Answer(const ObservationFiles& files);
  /// Returns the answer; throws a DetectorFailure that says how the program ended.
  std::string Talk(const std::string& request, double limit_s);
  /// Replaces the path of the temporary folder, which differs in every run, by `.`.
  std::string WithoutFolder(const std::string& detail) const;

  ExternalCommand command_;
  PrivateFolder folder_;
  ChildProcess process_;
  int64_t last_id_ = 0;
  bool running_ = true;
};

}  // namespace fenestra
