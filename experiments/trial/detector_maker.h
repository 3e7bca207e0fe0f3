#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "experiments/study/study.h"
#include "vision/external/external_detector.h"

namespace fenestra {

/// Makes the detectors that studies choose, in this process or as programs of their own, and keeps
/// these programs running from one cell to the next. Thread-safe.
class DetectorMaker {
 public:
  /// `serve_command`: the words that make this program serve a detector (`fenestra serve`), to
  /// which the detector's name is added. Without them no detector can be isolated.
  explicit DetectorMaker(std::vector<std::string> serve_command = {})
      : serve_command_(std::move(serve_command)) {}

  /// Whether the detector came with Fenestra, and not with a plugin or as a program.
  static bool IsOwn(const DetectorChoice& choice);

  /// The choice must be one that a study reader made, and its sensor that of the calibration.
  /// Throws InputError if one of Fenestra's own detectors refuses the calibration, isolated or not.
  std::unique_ptr<Detector> Make(const DetectorChoice& choice,
                                 const SensorCalibration& calibration);

  /// Starts a program of each detector that is one, so that a program that does not exist ends a
  /// run before its first trial. Throws InputError.
  void Start(const Study& study);
  void Start(const DetectorChoice& choice);

 private:
  std::shared_ptr<ProgramPool> PoolOf(const DetectorChoice& choice);

  std::vector<std::string> serve_command_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<ProgramPool>> pools_;
};

}  // namespace fenestra
