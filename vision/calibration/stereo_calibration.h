#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// The corners found in one pair of images of the board.
struct NamedView {
  std::string name;
  BoardView corners;
};

struct StereoCalibratorOptions {
  cv::Size left_size;
  cv::Size right_size;
  AdjustmentOptions adjustment = {};
  /// A view is left out as a wrong detection if its RMS exceeds that of the median view by this
  /// factor. The noise of corners differs between views by a factor of two or three.
  double outlier_factor = 4.0;
};

/// Agreement of a view with the calibration.
struct ViewResiduals {
  std::string name;
  double left_rms_px;  ///< √(Σ|r|²/n) over the view's n corners.
  double right_rms_px;
};

/// Residual of one corner: observed minus projected.
struct CornerResidual {
  Eigen::Vector2d pixel;  ///< Where the corner was observed.
  Eigen::Vector2d residual_px;
};

/// A view that was not used, and the reason.
struct LeftOutView {
  std::string name;
  std::string reason;
};

struct StereoCalibrationResult {
  StereoCalibration calibration;
  /// Covariance of all parameters of the pair, with board poses marginalised, in PairVector's order
  /// and units.
  PairMatrix covariance;
  double corner_deviation_px;  ///< Standard deviation of a corner's coordinate, from the residuals.
  double rms_px;               ///< √(Σ|r|²/n) over all corners of both cameras.
  std::array<double, 2> camera_rms_px;  ///< Left, right.
  std::vector<ViewResiduals> views;
  std::array<std::vector<CornerResidual>, 2> residuals;  ///< Left, right.
  std::vector<LeftOutView> left_out;
};

/// Names of PairVector's elements: "left fx [px]", …
const std::array<std::string, kPairParameters>& PairParameterNames();

/// Calibrates a stereo pair: each camera alone (cv::calibrateCamera, k3 = 0 unless it is free),
/// then the pose between them (cv::stereoCalibrate), then all parameters together (AdjustPair).
/// Views in which a camera sees fewer than 6 corners, or in which both see fewer than 6 common
/// ones, are left out with a reason.
///
/// Throws InputError if fewer than 3 views remain or if they do not determine the cameras, i.e. if
/// the standard deviation of a focal length exceeds 5 %.
StereoCalibrationResult CalibrateStereo(const std::vector<NamedView>& views,
                                        const CalibrationBoard& board,
                                        const StereoCalibratorOptions& options);

}  // namespace fenestra
