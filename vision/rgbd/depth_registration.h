#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "core/calibration.h"
#include "core/depth_carrier.h"
#include "core/observation.h"

namespace fenestra {

/// Colour and depth seen through one pinhole camera, pixel for pixel.
struct RegisteredImages {
  cv::Mat3b color;
  cv::Mat1f depth_m;  ///< Along the optical axis; 0 means none.
};

/// The camera in which colour and depth are brought together. It stands where the colour camera
/// stands (frame K), has no distortion, and its image is the colour image resampled by
///
///     s = min(1, w_D / w_K, fx_D / fx_K, fy_D / fy_K),
///
/// rounded to whole pixels with the image borders kept: as many columns as the depth image, never
/// finer than the colour image, and never finer than the depth pixels, since then a surface that
/// faces the camera would get holes. For a Kinect, s = 1/2; for registered depth, s = 1.
CameraModel WorkingCamera(const RgbdCalibration& calibration);

/// Registers depth to colour. The colour image is freed of distortion (bilinear) and averaged over
/// the area of each working pixel, on its encoded values, as the threshold of Algorithm 1 is set on
/// encoded values. Depth is reprojected to the working camera (DepthReprojection); rolled by 0.03
/// rad, 0.8 % of a Kinect's pixels stay empty. Where D already is the working camera and X_KD the
/// identity, both images are taken as they are.
class DepthRegistration {
 public:
  explicit DepthRegistration(const RgbdCalibration& calibration);

  /// Throws InputError if the image sizes or the depth unit are not those of the calibration.
  RegisteredImages Register(const RgbdObservation& observation) const;

  const CameraModel& working_camera() const { return working_; }

 private:
  cv::Mat3b ResampleColor(const cv::Mat3b& color) const;
  cv::Mat1f ReprojectDepth(const DepthImage& depth) const;

  RgbdCalibration calibration_;
  CameraModel working_;
  std::optional<DepthReprojection> reprojection_;  ///< Unless depth is registered already.
  /// Where each undistorted colour pixel lies in the colour image; empty without distortion.
  cv::Mat2f undistortion_;
};

}  // namespace fenestra
