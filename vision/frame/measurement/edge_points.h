#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/frame/measurement/side_request.h"

namespace fenestra {

/// A place on a side of the frame where an edge was found in the image.
struct EdgePoint {
  Side side;
  Border border;
  double share;            ///< Share of the way along the side.
  Eigen::Vector2d normal;  ///< Unit normal of the edge, away from the frame's centre.
  Eigen::Vector2d pixel;
  double sigma_px;  ///< Standard deviation of `pixel` along `normal`.
  /// Standard deviation of an additional error that all points of this side share in this view. It
  /// comes from the uncertainty of blur, slopes and full scale.
  double common_sigma_px = 0.0;
  /// Standard deviation along each axis of a displacement that near points share; see EdgeShift.
  double shift_sigma_px = 0.0;
};

struct SideEdges {
  std::vector<EdgePoint> points;
  int places = 0;  ///< Where an edge was looked for.
  EdgeNuisance nuisance;
};

/// Locates the edge along a side of the frame, near the place where the assumed frame predicts it.
/// The side is cut into strips (side_sampling.h), and a step is fitted to all pixels of each strip
/// (step_fit.h). A pixel's weight is the inverse of its variance, which changes from that of the
/// dark side to that of the bright side with P. The variance of s0 is that of the fit, scaled by
/// the mean square of the residuals: by its median over the side's strips, since a single strip has
/// few pixels, or by the strip's own value where that is more than twice the median. Strips without
/// such an edge are left out.
///
/// Pixels far from the edge are included because in a few pixels near it, a gradient of the light
/// is hardly distinguishable from a shift of the edge.
SideEdges MeasureSide(const CameraView& view, const FrameRectangle& frame,
                      const SideRequest& request, const EdgeNuisance& nuisance);

}  // namespace fenestra
