#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "core/detection/detection_json.h"
#include "core/detection/observation.h"
#include "vision/external/external_command.h"

namespace fenestra {

/// Protocol between Fenestra and a detector that is a separate program: one JSON object per line,
/// on the program's standard input and output. Version 1:
///
///     > {"request": "hello", "protocol": 1, "sensor": "stereo", "options": {"size_m": 0.8}}
///     < {"protocol": 1}                      or {"error": "size_m must be positive"}
///     > {"request": "detect", "id": 1, "left": "/dev/shm/…/left.png", "right": …,
///        "calibration": "/dev/shm/…/calibration.yaml"}
///     < {"id": 1, "outcome": "window", "centroid_m": […], …}     (core/detection/detection_json.h)
///     < {"id": 1, "outcome": "miss", "reason": "no_contour", "detail": "…"}
///     < {"id": 1, "outcome": "error", "detail": "…"}             costs this observation alone
///
/// For an RGB-D sensor the files are "color", "depth" and "calibration". The program must exit at
/// the end of its standard input.
inline constexpr int kDetectorProtocol = 1;

std::string HelloRequest(const ExternalCommand& command);
std::string DetectRequest(int64_t id, const ObservationFiles& files);

/// Throws DetectorFailure of kind "refused" with the program's reason, "bad_json" or "bad_answer".
void CheckHelloAnswer(std::string_view line);
/// Throws DetectorFailure: "exception" where the program reports an error, "bad_json" for a line
/// that is not JSON, "wrong_id" for an answer to something else, "bad_answer" for the rest.
TimedDetection ParseDetectAnswer(std::string_view line, int64_t id);

/// Requests as the program receives them. ParseRequest throws std::runtime_error for a line that is
/// not a request.
struct Hello {
  int protocol;
  SensorKind sensor;
  std::map<std::string, ParameterValue> options;
};
struct DetectOrder {
  int64_t id;
  ObservationFiles files;
};
std::variant<Hello, DetectOrder> ParseRequest(std::string_view line);

std::string HelloAnswer();
std::string RefusalAnswer(const std::string& reason);
std::string DetectAnswer(int64_t id, const TimedDetection& detection);
std::string ErrorAnswer(int64_t id, const std::string& detail);

}  // namespace fenestra
