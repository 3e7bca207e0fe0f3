#include "vision/rgbd/observation_check.h"

#include <fmt/format.h>

#include "core/io/faults.h"

namespace fenestra {
namespace {

std::string SizeText(const cv::Size& size) {
  return fmt::format("{} x {} px", size.width, size.height);
}

cv::Size SizeOf(const CameraModel& camera) {
  return {camera.width_px(), camera.height_px()};
}

}  // namespace

void CheckFits(const RgbdObservation& observation, const RgbdCalibration& calibration) {
  Faults faults;
  const auto require = [&faults](const char* image, bool holds, std::string message) {
    if (!holds) faults.AddFault({.source = image, .message = std::move(message)});
  };
  const auto require_size = [&require](const char* image, const cv::Size& found,
                                       const cv::Size& want) {
    require(image, found == want,
            fmt::format("the image has {}, its calibration {}", SizeText(found), SizeText(want)));
  };
  require_size("color", observation.color.size(), SizeOf(calibration.color));
  require_size("depth", observation.depth.raw.size(), SizeOf(calibration.depth));
  require("depth", observation.depth.unit_m == calibration.depth_unit_m,
          fmt::format("the image has a unit of {} m, its calibration {} m",
                      observation.depth.unit_m, calibration.depth_unit_m));
  faults.ThrowIfAny();
}

}  // namespace fenestra
