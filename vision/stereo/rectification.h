#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "vision/stereo/rectified_camera.h"

namespace fenestra {

/// Both images of a pair, resampled so that a point in space has the same row in both.
struct RectifiedPair {
  cv::Mat1b left;
  cv::Mat1b right;
};

/// Bouguet's rectification: each camera is turned by half of the relative rotation, then both so
/// that the baseline becomes the image's x axis. G. Bradski and A. Kaehler, "Learning OpenCV",
/// 2008, ch. 12; cv::stereoRectify with CALIB_ZERO_DISPARITY (both principal points equal, so that
/// infinity has disparity 0). The maps are computed once; resampling is bilinear.
class StereoRectification {
 public:
  /// `alpha`: 0 zooms until only pixels that both sensors saw remain, 1 shrinks until none that a
  /// sensor saw is lost. Throws InputError unless both images have one size of at least
  /// kSmallestSidePx and the right camera stands to the right of the left one, nearer to its
  /// x axis than to its y axis.
  StereoRectification(const StereoCalibration& calibration, double alpha);

  /// Below this the corners that fix the zoom fall together and rectification is undefined.
  static constexpr int kSmallestSidePx = 16;

  /// Throws InputError if an image's size is not the calibration's.
  RectifiedPair Rectify(const StereoObservation& observation) const;

  const RectifiedCamera& camera() const { return camera_; }
  /// p_LQ = R_LF p_FQ. L: the unrectified left camera.
  const Eigen::Matrix3d& R_LF() const { return R_LF_; }
  /// 255 where a rectified pixel shows something that the sensor saw, 0 in the margins.
  const cv::Mat1b& left_seen() const { return left_.seen; }
  const cv::Mat1b& right_seen() const { return right_.seen; }

 private:
  struct View {
    cv::Mat map;  ///< In cv::remap's fixed-point form, the fast one.
    cv::Mat interpolation;
    cv::Mat1b seen;
  };
  static View MakeView(const CameraModel& source, const cv::Mat& R_FC, const cv::Mat& P_F);

  cv::Size size_;
  RectifiedCamera camera_;
  Eigen::Matrix3d R_LF_;
  View left_;
  View right_;
};

}  // namespace fenestra
