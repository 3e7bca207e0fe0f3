#include "vision/external/external_detector.h"

#include "core/detection/detector.h"
#include "core/io/input_error.h"
#include "core/io/system_error.h"
#include "core/system/check.h"

namespace fenestra {

void ProgramPool::Start() {
  auto program = Take();
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(program));
}

std::unique_ptr<DetectorProgram> ProgramPool::Take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      auto program = std::move(idle_.back());
      idle_.pop_back();
      return program;
    }
  }
  return std::make_unique<DetectorProgram>(command_);
}

TimedDetection ProgramPool::Ask(const Observation& observation,
                                const SensorCalibration& calibration) {
  const auto started = [](const auto& start) {
    try {
      return start();
    } catch (const InputError& error) {
      throw DetectorFailure("start", error.what());
    }
  };
  try {
    return AskOnce(started([this] { return Take(); }), observation, calibration);
  } catch (const SystemError&) {
    // What took this program's folder may have taken those of the idle ones, too.
    return AskOnce(started([this] { return std::make_unique<DetectorProgram>(command_); }),
                   observation, calibration);
  }
}

TimedDetection ProgramPool::AskOnce(std::unique_ptr<DetectorProgram> program,
                                    const Observation& observation,
                                    const SensorCalibration& calibration) {
  const auto keep = [&] {
    if (!program->running()) return;
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(program));
  };
  try {
    TimedDetection answer = program->Ask(observation, calibration);
    keep();
    return answer;
  } catch (const DetectorFailure&) {
    keep();
    throw;
  }
}

ExternalDetector::ExternalDetector(std::shared_ptr<ProgramPool> pool, SensorCalibration calibration)
    : pool_(std::move(pool)), calibration_(std::move(calibration)) {
  const bool stereo = std::holds_alternative<StereoCalibration>(calibration_);
  FENESTRA_CHECK(stereo == (sensor() == SensorKind::kStereo), "calibration of another sensor");
}

Detection ExternalDetector::Detect(const Observation& observation, StageLog& log) const {
  const bool stereo = std::holds_alternative<StereoObservation>(observation);
  if (stereo != (sensor() == SensorKind::kStereo)) {
    throw InputError("observation", "is not of this detector's sensor");
  }
  const TimedDetection answer = pool_->Ask(observation, calibration_);
  for (const StageTime& stage : answer.stages) log.Add(stage);
  return answer.detection;
}

}  // namespace fenestra
