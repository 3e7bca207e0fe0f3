#include "vision/stereo/rectified_pictures.h"

#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

constexpr int kLines = 8;

}  // namespace

cv::Mat3b DrawRectifiedPair(const RectifiedPair& pair) {
  cv::Mat1b both;
  cv::hconcat(pair.left, pair.right, both);
  cv::Mat3b picture;
  cv::cvtColor(both, picture, cv::COLOR_GRAY2BGR);
  for (int i = 1; i < kLines; ++i) {
    const int v = i * picture.rows / kLines;
    cv::line(picture, {0, v}, {picture.cols - 1, v}, {80, 200, 80});
  }
  return picture;
}

std::array<PictureView, 2> RectifiedViews(const StereoRectification& rectification) {
  const RectifiedCamera& camera = rectification.camera();
  const cv::Size size = rectification.left_seen().size();
  CameraParameters pinhole{.width_px = size.width,
                           .height_px = size.height,
                           .fx_px = camera.f_px,
                           .fy_px = camera.f_px,
                           .cx_px = camera.cx_px,
                           .cy_px = camera.cy_px,
                           .distortion = {}};
  const Pose X_FL(rectification.R_LF().transpose(), Eigen::Vector3d::Zero());
  const PictureView left{CameraModel(pinhole), X_FL};
  pinhole.cx_px += size.width;  // The right image stands beside the left one.
  const Pose X_RF = Pose::Translation({-camera.baseline_m, 0.0, 0.0});
  return {left, PictureView{CameraModel(pinhole), X_RF * X_FL}};
}

}  // namespace fenestra
