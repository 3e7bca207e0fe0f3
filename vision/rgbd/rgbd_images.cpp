#include "vision/rgbd/rgbd_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/io/faults.h"

namespace fenestra {
namespace {

std::string SizeText(const cv::Size& size) {
  return fmt::format("{} x {} px", size.width, size.height);
}

cv::Size SizeOf(const CameraModel& camera) {
  return {camera.width_px(), camera.height_px()};
}

// A pixel outside the image where the lens sees nothing, so that it becomes black there.
constexpr float kOutside = -1e4f;

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

CameraModel WithoutDistortion(const CameraModel& camera) {
  CameraParameters parameters = camera.parameters();
  parameters.distortion = {};
  return CameraModel(parameters);
}

cv::Mat2f UndistortionMap(const CameraModel& camera) {
  const CameraModel pinhole = WithoutDistortion(camera);
  cv::Mat2f map(camera.height_px(), camera.width_px(), cv::Vec2f(kOutside, kOutside));
  for (int v = 0; v < map.rows; ++v) {
    for (int u = 0; u < map.cols; ++u) {
      const auto ray = pinhole.UnprojectRay({u, v});
      const auto pixel = ray ? camera.Project(*ray) : std::nullopt;
      if (pixel) map(v, u) = {static_cast<float>(pixel->x()), static_cast<float>(pixel->y())};
    }
  }
  return map;
}

cv::Mat3b DrawDepth(const cv::Mat1f& depth_m) {
  const cv::Mat1b seen = depth_m > 0.0f;
  cv::Mat3b drawn = cv::Mat3b::zeros(depth_m.size());
  if (cv::countNonZero(seen) == 0) return drawn;
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  cv::minMaxLoc(depth_m, &nearest_m, &farthest_m, nullptr, nullptr, seen);
  const double scale = -255.0 / std::max(farthest_m - nearest_m, 1e-3);
  cv::Mat1b nearness;
  depth_m.convertTo(nearness, CV_8U, scale, 255.0 - scale * nearest_m);
  cv::Mat3b colors;
  cv::applyColorMap(nearness, colors, cv::COLORMAP_TURBO);
  colors.copyTo(drawn, seen);
  return drawn;
}

}  // namespace fenestra
