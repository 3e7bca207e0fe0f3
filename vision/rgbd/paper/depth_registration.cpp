#include "vision/rgbd/paper/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/rgbd/rgbd_images.h"

namespace fenestra {
namespace {

cv::Size SizeOf(const CameraModel& camera) {
  return {camera.width_px(), camera.height_px()};
}

}  // namespace

CameraModel WorkingCamera(const RgbdCalibration& calibration) {
  CameraParameters p = calibration.color.parameters();
  const CameraParameters& d = calibration.depth.parameters();
  const double s = std::min(
      {1.0, static_cast<double>(d.width_px) / p.width_px, d.fx_px / p.fx_px, d.fy_px / p.fy_px});
  const int width_px = std::max(1, static_cast<int>(std::lround(s * p.width_px)));
  const int height_px = std::max(1, static_cast<int>(std::lround(s * p.height_px)));
  // The scales after rounding to whole pixels; both equal s if the sizes divide.
  const double sx = static_cast<double>(width_px) / p.width_px;
  const double sy = static_cast<double>(height_px) / p.height_px;
  return CameraModel({.width_px = width_px,
                      .height_px = height_px,
                      .fx_px = sx * p.fx_px,
                      .fy_px = sy * p.fy_px,
                      .cx_px = sx * (p.cx_px + 0.5) - 0.5,
                      .cy_px = sy * (p.cy_px + 0.5) - 0.5,
                      .distortion = {}});
}

DepthRegistration::DepthRegistration(const RgbdCalibration& calibration)
    : calibration_(calibration), working_(WorkingCamera(calibration)) {
  if (calibration.depth != working_ || calibration.X_KD != Pose()) {
    reprojection_.emplace(calibration.depth, calibration.X_KD, working_);
  }
  if (calibration.color.has_distortion()) undistortion_ = UndistortionMap(calibration.color);
}

RegisteredImages DepthRegistration::Register(const RgbdObservation& observation) const {
  CheckFits(observation, calibration_);
  return {ResampleColor(observation.color), ReprojectDepth(observation.depth)};
}

cv::Mat3b DepthRegistration::ResampleColor(const cv::Mat3b& color) const {
  cv::Mat3b resampled = color;
  if (!undistortion_.empty()) {
    // What the lens does not see is as its border: black would be taken for dark paint.
    cv::Mat3b undistorted;
    cv::remap(color, undistorted, undistortion_, cv::noArray(), cv::INTER_LINEAR,
              cv::BORDER_REPLICATE);
    resampled = undistorted;
  }
  if (resampled.size() == SizeOf(working_)) return resampled;
  cv::Mat3b averaged;
  cv::resize(resampled, averaged, SizeOf(working_), 0.0, 0.0, cv::INTER_AREA);
  return averaged;
}

cv::Mat1f DepthRegistration::ReprojectDepth(const DepthImage& depth) const {
  if (reprojection_) return reprojection_->Reproject(depth).depth_m;
  cv::Mat1f depth_m;
  depth.raw.convertTo(depth_m, CV_32F, depth.unit_m);
  return depth_m;
}

}  // namespace fenestra
