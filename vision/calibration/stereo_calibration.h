#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// One pair of pictures of the board, or what was found in it.
struct NamedView {
  std::string name;
  BoardView corners;
};

struct StereoCalibratorOptions {
  cv::Size left_size;
  cv::Size right_size;
  AdjustmentOptions adjustment = {};
  /// A view is left out if its RMS exceeds that of the median view by this factor: a wrong
  /// detection. Corners' noise differs between views by a factor of two or three.
  double outlier_factor = 4.0;
};

/// How a view agrees with the calibration.
struct ViewResiduals {
  std::string name;
  double left_rms_px;  ///< √(Σ|r|²/n) over the view's n corners.
  double right_rms_px;
};

/// Residual of one corner: seen less projected.
struct CornerResidual {
  Eigen::Vector2d pixel;  ///< Where it was seen.
  Eigen::Vector2d residual_px;
};

/// A view that was not used, and why.
struct LeftOutView {
  std::string name;
  std::string reason;
};

struct StereoCalibrationResult {
  StereoCalibration calibration;
  /// Of all parameters of the pair, board poses marginalised; PairVector's order and units.
  PairMatrix covariance;
  double corner_deviation_px;           ///< σ of one coordinate of a corner, by the residuals.
  double rms_px;                        ///< √(Σ|r|²/n) over all corners of both cameras.
  std::array<double, 2> camera_rms_px;  ///< Left, right.
  std::vector<ViewResiduals> views;
  std::array<std::vector<CornerResidual>, 2> residuals;  ///< Left, right.
  std::vector<LeftOutView> left_out;
};

/// Names of PairVector's elements: "left fx [px]", …
const std::array<std::string, kPairParameters>& PairParameterNames();

/// Calibrates a stereo pair: each camera alone (cv::calibrateCamera, k3 = 0 unless it is free),
/// then the pose between them (cv::stereoCalibrate), then both together (AdjustPair). Views in
/// which a camera sees fewer than 6 corners, or fewer than 6 are seen by both, are left out, with a
/// reason.
///
/// Throws InputError if fewer than 3 views remain, or they do not determine the cameras: a focal
/// length that is uncertain by more than 5 %.
StereoCalibrationResult CalibrateStereo(const std::vector<NamedView>& views,
                                        const CalibrationBoard& board,
                                        const StereoCalibratorOptions& options);

}  // namespace fenestra
