#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "vision/external/detector_program.h"

namespace fenestra {

/// A pool of running programs of one command, as many as are used at the same time. Thread-safe.
class ProgramPool {
 public:
  explicit ProgramPool(ExternalCommand command) : command_(std::move(command)) {}

  const ExternalCommand& command() const { return command_; }

  /// Starts the first program, if none is running. Throws InputError (DetectorProgram).
  void Start();
  /// Asks an idle program, or a new one, and keeps it if it is still running afterwards. Throws
  /// DetectorFailure as DetectorProgram::Ask does, or with "start" if no program can be started;
  /// SystemError if the machine failed twice in a row.
  TimedDetection Ask(const Observation& observation, const SensorCalibration& calibration);

 private:
  TimedDetection AskOnce(std::unique_ptr<DetectorProgram> program, const Observation& observation,
                         const SensorCalibration& calibration);
  std::unique_ptr<DetectorProgram> Take();

  ExternalCommand command_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<DetectorProgram>> idle_;
};

/// A detector that runs as a separate program.
class ExternalDetector : public Detector {
 public:
  /// The calibration's sensor must be the command's.
  ExternalDetector(std::shared_ptr<ProgramPool> pool, SensorCalibration calibration);

  SensorKind sensor() const override { return pool_->command().sensor; }
  Detection Detect(const Observation& observation, StageLog& log) const override;

 private:
  std::shared_ptr<ProgramPool> pool_;
  SensorCalibration calibration_;
};

}  // namespace fenestra
