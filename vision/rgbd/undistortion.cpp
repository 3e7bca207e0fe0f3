#include "vision/rgbd/undistortion.h"

namespace fenestra {
namespace {

// A pixel outside the image where the lens sees nothing, so that it becomes black there.
constexpr float kOutside = -1e4f;

}  // namespace

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

}  // namespace fenestra
