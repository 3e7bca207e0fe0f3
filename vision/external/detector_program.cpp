#include "vision/external/detector_program.h"

#include <fmt/format.h>

#include "core/detection/detector.h"
#include "core/io/input_error.h"
#include "core/io/system_error.h"

namespace fenestra {

DetectorProgram::DetectorProgram(const ExternalCommand& command)
    : command_(command), process_(command.words) {
  try {
    CheckHelloAnswer(Talk(HelloRequest(command_), command_.start_limit_s));
  } catch (const DetectorFailure& failure) {
    throw InputError(command_.Title(),
                     fmt::format("does not answer hello as a detector does: {}", failure.what()));
  }
}

std::string DetectorProgram::Talk(const std::string& request, double limit_s) {
  const ChildProcess::Reply reply = process_.Exchange(request, limit_s);
  if (reply.end == ChildProcess::End::kLine) return reply.line;
  running_ = false;
  const bool closed = reply.end == ChildProcess::End::kClosed;
  const std::string end = process_.Stop(closed ? ChildProcess::kGrace_s : 0.0);
  if (reply.end == ChildProcess::End::kTimeout) {
    throw DetectorFailure("timeout", fmt::format("no answer within {} s", limit_s));
  }
  if (reply.end == ChildProcess::End::kFlood) {
    throw DetectorFailure(
        "flood", "it wrote more than the one line of an answer; notes go to standard error");
  }
  const std::string last = process_.LastError();
  throw DetectorFailure("died", WithoutFolder(last.empty() ? end : end + ": " + last));
}

std::string DetectorProgram::WithoutFolder(const std::string& detail) const {
  std::string told = detail;
  const std::string folder = folder_.path().string();
  for (size_t at = told.find(folder); at != std::string::npos; at = told.find(folder, at)) {
    told.replace(at, folder.size(), ".");
  }
  return told;
}

void DetectorProgram::RequireThere(const ObservationFiles& files) const {
  folder_.RequireThere();
  for (const auto* file :
       {&files.left, &files.right, &files.color, &files.depth, &files.calibration}) {
    if (!file->empty() && !std::filesystem::exists(*file)) {
      throw SystemError(*file, "was removed while a detector was to read it");
    }
  }
}

ObservationFiles DetectorProgram::Hand(const Observation& observation,
                                       const SensorCalibration& calibration) const {
  folder_.RequireThere();
  try {
    WriteObservation(folder_.path(), observation, calibration);
  } catch (const InputError& error) {
    throw SystemError(error.what());
  }
  return ObservationFiles::In(folder_.path(), command_.sensor);
}

TimedDetection DetectorProgram::Ask(const Observation& observation,
                                    const SensorCalibration& calibration) {
  const ObservationFiles files = Hand(observation, calibration);
  try {
    return Answer(files);
  } catch (const DetectorFailure&) {
    RequireThere(files);
    throw;
  }
}

TimedDetection DetectorProgram::Answer(const ObservationFiles& files) {
  const int64_t id = ++last_id_;
  const Clock clock = SteadyClock();
  const double start = clock();
  const std::string line = Talk(DetectRequest(id, files), command_.time_limit_s);
  const double seconds = clock() - start;
  try {
    TimedDetection answer = ParseDetectAnswer(line, id);
    if (answer.stages.empty()) answer.stages = {{"answer", seconds}};
    return answer;
  } catch (const DetectorFailure& failure) {
    // A program that sends an unexpected answer may be out of step; a reported error is a proper
    // answer.
    if (failure.kind() != "exception") {
      running_ = false;
      process_.Stop(0.0);
    }
    throw DetectorFailure(failure.kind(), WithoutFolder(failure.what()));
  }
}

}  // namespace fenestra
