#pragma once

#include <opencv2/core.hpp>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"
#include "vision/frame/measurement/edge_shift.h"
#include "vision/frame/model/frame_rectangle.h"

namespace fenestra {

/// An image as its camera delivered it. It is not rectified, so the noise of its pixels is
/// independent.
struct CameraView {
  CameraModel camera;
  Pose X_CL;  ///< C is this camera.
  cv::Mat1b image;
};

/// Nuisance parameters of the edge model for one side (see step_fit.h), estimated while the side is
/// measured and used when it is measured next.
struct EdgeNuisance {
  static constexpr int kShared = 5;
  /// Standard deviation of the lens blur in the middle of the side, its linear and quadratic change
  /// along the side [px], and the slopes of the grey values outside and inside as shares of the
  /// step [1/px].
  Eigen::Matrix<double, kShared, 1> shared = {0.5, 0.0, 0.0, 0.0, 0.0};
  double dark_variance = 1.0;  ///< Variance of the grey values on the dark side [DN²].
  double bright_variance = 1.0;
  double rise_dn = 0.0;  ///< Mean step, used only where pixels are at full scale; 0: not known yet.
  /// Whether pixels beyond SideRequest::reach_px fit the model as well as those within it.
  bool is_even = true;

  double blur_px() const { return shared[0]; }
  double blur_change_px() const { return shared[1]; }
  double blur_bend_px() const { return shared[2]; }
  double slope_outside() const { return shared[3]; }
  double slope_inside() const { return shared[4]; }
};

enum class Brighter { kOutside, kInside };

/// Vignetting: grey values above black_dn fall off as cos^power of the angle to the optical axis.
/// The power is 4 for natural vignetting and 0 if the camera corrects it.
struct Vignetting {
  double black_dn;
  double power;
};

struct SideRequest {
  Side side;
  Border border;
  Brighter brighter;
  double reach_px;  ///< Pixels up to here from the edge are used,
  /// and on the side that is away from the border up to here, while they are even.
  double far_px;
  double min_contrast_dn;
  Vignetting vignetting;
  EdgeShift shift{};
  bool coarse = false;  ///< Measures only every third strip.

  double inside_px() const { return border == Border::kOuter ? reach_px : far_px; }
  double outside_px() const { return border == Border::kOuter ? far_px : reach_px; }
};

}  // namespace fenestra
