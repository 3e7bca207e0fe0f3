#include "vision/rgbd/observation_check.h"

#include <fmt/format.h>

#include "core/input_error.h"

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
  std::vector<InputFault> faults;
  const auto demand_size = [&faults](const char* name, const cv::Size& found,
                                     const cv::Size& want) {
    if (found == want) return;
    faults.push_back(
        {name, 0, 0,
         fmt::format("the image has {}, its calibration {}", SizeText(found), SizeText(want))});
  };
  demand_size("color", observation.color.size(), SizeOf(calibration.color));
  demand_size("depth", observation.depth.raw.size(), SizeOf(calibration.depth));
  if (observation.depth.unit_m != calibration.depth_unit_m) {
    faults.push_back({"depth", 0, 0,
                      fmt::format("the image has a unit of {} m, its calibration {} m",
                                  observation.depth.unit_m, calibration.depth_unit_m)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace fenestra
