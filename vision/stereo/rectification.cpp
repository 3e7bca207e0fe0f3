#include "vision/stereo/rectification.h"

#include <fmt/format.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

cv::Mat OpenCvMatrix(const CameraModel& camera) {
  cv::Mat K;
  cv::eigen2cv(camera.Matrix(), K);
  return K;
}

cv::Mat OpenCvDistortion(const CameraModel& camera) {
  const BrownConrady& d = camera.parameters().distortion;
  return (cv::Mat_<double>(1, 5) << d.k1, d.k2, d.p1, d.p2, d.k3);
}

void Validate(const StereoCalibration& calibration) {
  Faults faults("stereo calibration");
  const CameraModel& l = calibration.left;
  const CameraModel& r = calibration.right;
  faults.Require(l.width_px() == r.width_px() && l.height_px() == r.height_px(),
                 fmt::format("the images must have one size, not {} x {} px and {} x {} px",
                             l.width_px(), l.height_px(), r.width_px(), r.height_px()));
  const int smallest = StereoRectification::kSmallestSidePx;
  faults.Require(
      std::min({l.width_px(), l.height_px(), r.width_px(), r.height_px()}) >= smallest,
      fmt::format("images must be at least {} px wide and high to be rectified", smallest));
  const Eigen::Vector3d& p_RL = calibration.X_RL.translation();
  faults.Require(p_RL.x() < 0.0 && -p_RL.x() > std::abs(p_RL.y()),
                 fmt::format("the right camera must stand to the right of the left one; T is "
                             "({:g}, {:g}, {:g}) m where its x must be negative and the largest",
                             p_RL.x(), p_RL.y(), p_RL.z()));
  faults.ThrowIfAny();
}

void CheckSize(const cv::Mat1b& image, const cv::Size& size, const char* which) {
  if (image.size() == size) return;
  throw InputError(fmt::format("{} image", which),
                   fmt::format("is {} x {} px; the calibration is for {} x {} px", image.cols,
                               image.rows, size.width, size.height));
}

constexpr int kLines = 8;

}  // namespace

const StereoObservation& StereoPart(const Observation& observation) {
  const auto* stereo = std::get_if<StereoObservation>(&observation);
  if (stereo == nullptr) {
    throw InputError("observation", "is of an RGB-D sensor; this detector needs a stereo pair");
  }
  return *stereo;
}

StereoRectification::StereoRectification(const StereoCalibration& calibration, double alpha) {
  Validate(calibration);
  size_ = {calibration.left.width_px(), calibration.left.height_px()};
  cv::Mat R_RL;
  cv::Mat p_RL;
  cv::eigen2cv(calibration.X_RL.rotation(), R_RL);
  cv::eigen2cv(calibration.X_RL.translation(), p_RL);
  cv::Mat R_FL;
  cv::Mat R_FR;
  cv::Mat P_left;
  cv::Mat P_right;
  cv::Mat Q;
  cv::stereoRectify(OpenCvMatrix(calibration.left), OpenCvDistortion(calibration.left),
                    OpenCvMatrix(calibration.right), OpenCvDistortion(calibration.right), size_,
                    R_RL, p_RL, R_FL, R_FR, P_left, P_right, Q, cv::CALIB_ZERO_DISPARITY, alpha,
                    size_);
  const double f_px = P_left.at<double>(0, 0);
  camera_ = {.f_px = f_px,
             .cx_px = P_left.at<double>(0, 2),
             .cy_px = P_left.at<double>(1, 2),
             .baseline_m = -P_right.at<double>(0, 3) / f_px};
  if (!(std::isfinite(f_px) && f_px > 0.0 && camera_.baseline_m > 0.0)) {
    throw InputError("stereo calibration", "cannot be rectified: the cameras look too far apart");
  }
  FENESTRA_CHECK(P_left.at<double>(0, 2) == P_right.at<double>(0, 2), "zero disparity at infinity");
  Eigen::Matrix3d R_FL_eigen;
  cv::cv2eigen(R_FL, R_FL_eigen);
  R_LF_ = R_FL_eigen.transpose();
  left_ = MakeView(calibration.left, R_FL, P_left);
  right_ = MakeView(calibration.right, R_FR, P_right);
}

StereoRectification::View StereoRectification::MakeView(const CameraModel& source,
                                                        const cv::Mat& R_FC, const cv::Mat& P_F) {
  const cv::Size size(source.width_px(), source.height_px());
  View view;
  cv::initUndistortRectifyMap(OpenCvMatrix(source), OpenCvDistortion(source), R_FC, P_F, size,
                              CV_16SC2, view.map, view.interpolation);
  cv::remap(cv::Mat1b(size, 255), view.seen, view.map, view.interpolation, cv::INTER_NEAREST,
            cv::BORDER_CONSTANT, 0);
  return view;
}

RectifiedPair StereoRectification::Rectify(const StereoObservation& observation) const {
  CheckSize(observation.left, size_, "left");
  CheckSize(observation.right, size_, "right");
  // Outside the sensor the nearest pixel is repeated, because a constant would draw an edge around
  // the image, and edges match.
  RectifiedPair pair;
  cv::remap(observation.left, pair.left, left_.map, left_.interpolation, cv::INTER_LINEAR,
            cv::BORDER_REPLICATE);
  cv::remap(observation.right, pair.right, right_.map, right_.interpolation, cv::INTER_LINEAR,
            cv::BORDER_REPLICATE);
  return pair;
}

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
