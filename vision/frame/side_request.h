#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/camera_model.h"
#include "core/pose.h"
#include "vision/frame/frame_rectangle.h"

namespace fenestra {

/// An image as its camera delivered it, not rectified: its pixels' noise is independent.
struct CameraView {
  CameraModel camera;
  Pose X_CL;  ///< C: this camera.
  cv::Mat1b image;
};

/// A place on a side of the frame where the image's edge was found.
struct EdgePoint {
  Side side;
  Border border;
  double share;            ///< Of the way along the side.
  Eigen::Vector2d normal;  ///< Across the edge, out of the frame's centre.
  Eigen::Vector2d pixel;
  double sigma_px;  ///< Standard deviation of `pixel` along `normal`.
  /// What all points of this side in this view may be off together, besides: what is not known of
  /// blur, slopes and full scale, and what the model of lens and light is worth.
  double common_sigma_px = 0.0;
};

/// What is learnt of a side while it is measured, for the next time (see step_fit.h).
struct EdgeTuning {
  static constexpr int kShared = 5;
  /// Standard deviation of the lens' blur in the middle of the side, how it changes and bends along
  /// it [px], and slopes of the grey values outside and inside, as shares of the step [1/px].
  Eigen::Matrix<double, kShared, 1> shared = {0.5, 0.0, 0.0, 0.0, 0.0};
  double dark_variance = 1.0;  ///< Of the grey values on either side [DN²].
  double bright_variance = 1.0;
  double rise_dn = 0.0;  ///< Mean step; 0: not known yet. Only used where pixels are at full scale.
  /// Whether pixels beyond SideRequest::reach_px fit as well as those within it.
  bool is_even = true;

  double blur_px() const { return shared[0]; }
  double blur_change_px() const { return shared[1]; }
  double blur_bend_px() const { return shared[2]; }
  double slope_outside() const { return shared[3]; }
  double slope_inside() const { return shared[4]; }
};

enum class Brighter { kOutside, kInside };

/// How light falls off from the image's centre: grey values above black_dn as cos^power of the
/// angle to the optical axis. 4 for natural vignetting, 0 where the camera corrects it.
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
  bool coarse = false;  ///< Every third strip only.

  double inside_px() const { return border == Border::kOuter ? reach_px : far_px; }
  double outside_px() const { return border == Border::kOuter ? far_px : reach_px; }
};

struct SideEdges {
  std::vector<EdgePoint> points;
  int places = 0;  ///< Where an edge was looked for.
  EdgeTuning tuning;
};

}  // namespace fenestra
