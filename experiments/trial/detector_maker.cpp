#include "experiments/trial/detector_maker.h"

#include "core/io/input_error.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

ExternalCommand CommandOf(const DetectorChoice& choice, std::vector<std::string> words) {
  return {.words = std::move(words),
          .sensor = choice.sensor,
          .options = choice.options,
          .time_limit_s = choice.process->time_limit_s,
          .start_limit_s = choice.process->start_limit_s};
}

}  // namespace

std::shared_ptr<ProgramPool> DetectorMaker::PoolOf(const DetectorChoice& choice) {
  std::vector<std::string> words = choice.process->command;
  if (words.empty()) {
    if (serve_command_.empty()) {
      throw InputError(choice.label, "cannot be isolated: this program cannot serve detectors");
    }
    words = serve_command_;
    words.push_back(choice.name);
  }
  const ExternalCommand command = CommandOf(choice, std::move(words));
  const std::lock_guard lock(mutex_);
  for (const auto& pool : pools_) {
    if (pool->command() == command) return pool;
  }
  pools_.push_back(std::make_shared<ProgramPool>(command));
  return pools_.back();
}

bool DetectorMaker::IsOwn(const DetectorChoice& choice) {
  if (choice.process && !choice.process->command.empty()) return false;
  const DetectorInfo* info = FindDetector(choice.name);
  return info != nullptr && !info->isolate;  // Plugins are isolated by default, and they alone.
}

std::unique_ptr<Detector> DetectorMaker::Make(const DetectorChoice& choice,
                                              const SensorCalibration& calibration) {
  // Made here even if it is to run in another process, which could only answer that it failed.
  if (!choice.process || IsOwn(choice)) {
    auto detector = MakeDetector(choice.name, calibration, choice.options);
    if (!choice.process) return detector;
  }
  return std::make_unique<ExternalDetector>(PoolOf(choice), calibration);
}

void DetectorMaker::Start(const DetectorChoice& choice) {
  if (choice.process) PoolOf(choice)->Start();
}

void DetectorMaker::Start(const Study& study) {
  for (const StudyPart& part : study.parts) {
    for (const DetectorChoice& choice : part.detectors) Start(choice);
  }
}

}  // namespace fenestra
