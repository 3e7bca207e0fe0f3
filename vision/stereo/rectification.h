#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>

#include "core/detection/observation.h"
#include "core/detection/stage_log.h"
#include "core/geometry/calibration.h"

namespace fenestra {

/// The rectified pair: two pinhole cameras with the same K and parallel axes, the right one
/// displaced by the baseline along +x. Frame F is that of the rectified left camera; it shares its
/// origin with L.
///
///     u = f X/Z + cx,   v = f Y/Z + cy                                    (rectified left pixel)
///     d = u_left - u_right = f B / Z                                      (disparity)
///
/// f, cx, cy, d [px]; B, X, Y, Z [m].
struct RectifiedCamera {
  double f_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double baseline_m = 0.0;

  /// Converts by Z = f B / d. Domain: positive values. First-order error: σ_Z = Z² σ_d / (f B).
  double DepthFromDisparity(double disparity_px) const { return f_px * baseline_m / disparity_px; }
  double DisparityFromDepth(double depth_m) const { return f_px * baseline_m / depth_m; }

  /// The direction (x, y, 1) of a pixel's ray in F.
  Eigen::Vector3d Ray(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - cx_px) / f_px, (pixel.y() - cy_px) / f_px, 1.0};
  }
};

/// Returns the images of a stereo observation. Throws InputError for an RGB-D observation.
const StereoObservation& StereoPart(const Observation& observation);

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

/// Draws both images side by side with horizontal lines, on which corresponding points must have
/// the same height.
cv::Mat3b DrawRectifiedPair(const RectifiedPair& pair);

/// Views that project points in L into DrawRectifiedPair's picture. The first one is for its left
/// half, and for any picture of the rectified left camera; the second is for its right half.
std::array<PictureView, 2> RectifiedViews(const StereoRectification& rectification);

}  // namespace fenestra
