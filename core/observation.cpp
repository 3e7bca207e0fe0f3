#include "core/observation.h"

namespace fenestra {

const char* ToString(SensorKind kind) {
  return kind == SensorKind::kStereo ? "stereo" : "rgbd";
}

}  // namespace fenestra
