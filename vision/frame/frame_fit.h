#pragma once

#include <array>
#include <vector>

#include "vision/frame/frame_adjustment.h"
#include "vision/frame/frame_rectangle.h"
#include "vision/frame/side_request.h"

namespace fenestra {

struct FrameFit {
  /// Of the rectangle of edges that were seen; of p_LO, the covariance is the front's.
  FrameAdjustment adjustment;
  FrameRectangle front;  ///< The frame's own, which may be behind that rectangle.
  std::vector<std::vector<EdgePoint>> points;  ///< By view.
  /// Shares of the places along the sides where the frame's edge was found: by side in the better
  /// view, and of all inner sides.
  std::array<double, 4> outer_support = {};
  std::array<double, 4> inner_supports = {};
  double inner_support = 0.0;
  bool is_flat = true;  ///< Whether the outer sides are in one plane, as well as the images tell.
  /// Whether the opening's edges were found in the plane of the outer ones.
  bool is_in_one_plane = false;

  double LeastSupport() const;  ///< Of the outer sides.
  double LeastInnerSupport() const;
  double MeanSupport() const;
};

}  // namespace fenestra
