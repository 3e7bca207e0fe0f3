#include "core/detection/observation.h"

namespace fenestra {

const char* ToString(SensorKind kind) {
  return kind == SensorKind::kStereo ? "stereo" : "rgbd";
}

std::optional<SensorKind> ParseSensorKind(std::string_view word) {
  for (const SensorKind kind : {SensorKind::kStereo, SensorKind::kRgbd}) {
    if (word == ToString(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace fenestra
