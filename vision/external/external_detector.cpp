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
  try {
    return AskOnce(observation, calibration);
  } catch (const SystemError&) {
    // The next program has a folder of its own, perhaps where there is more room.
    return AskOnce(observation, calibration);
  }
}

TimedDetection ProgramPool::AskOnce(const Observation& observation,
                                    const SensorCalibration& calibration) {
  std::unique_ptr<DetectorProgram> program;
  try {
    program = Take();
  } catch (const InputError& error) {
    throw DetectorFailure("start", error.what());
  }
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
