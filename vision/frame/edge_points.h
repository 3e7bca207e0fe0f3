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
};

/// What is learnt of an edge while it is measured, for the next time.
struct EdgeTuning {
  double blur_px = 0.5;        ///< Standard deviation of the lens' blur.
  double dark_variance = 1.0;  ///< Of the grey values on either side [DN²].
  double bright_variance = 1.0;
};

enum class Brighter { kOutside, kInside };

struct SideRequest {
  Side side;
  Border border;
  Brighter brighter;
  double reach_px;  ///< Pixels up to here from the edge are used.
  double min_contrast_dn;
};

struct SideEdges {
  std::vector<EdgePoint> points;
  int places = 0;  ///< Where an edge was looked for.
  EdgeTuning tuning;
};

/// Looks for the edge along a side of the frame, near to where the frame as it is assumed would
/// have it. The side is divided into places of some pixels' length; in each one
///
///     I = a + g P(s - s0)                                                     (blurred_step.h)
///
/// is fitted to all its pixels by weighted least squares, with s the pixel's distance from the
/// assumed edge. A pixel's weight is the inverse of its variance, which goes from the dark side's
/// to the bright one's with P. s0's variance is that of the fit, scaled by the residuals: by their
/// median over the side's places, since a place has few pixels, or by the place's own where
/// these are more than twice as large. Places without such an edge are left out.
SideEdges MeasureSide(const CameraView& view, const FrameRectangle& frame,
                      const SideRequest& request, const EdgeTuning& tuning);

}  // namespace fenestra
