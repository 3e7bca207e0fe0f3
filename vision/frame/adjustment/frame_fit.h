#pragma once

#include <array>
#include <vector>

#include "vision/frame/adjustment/frame_adjustment.h"
#include "vision/frame/measurement/edge_points.h"
#include "vision/frame/model/frame_rectangle.h"

namespace fenestra {

struct FrameFit {
  /// The rectangle of the edges that were seen. The covariance of p_LO is that of the front.
  FrameAdjustment adjustment;
  FrameRectangle front;  ///< The frame's own front, which may be behind that rectangle.
  std::vector<std::vector<EdgePoint>> points;  ///< Edge points of each view.
  /// Share of the places along the sides at which the frame's edge was found: for each side in the
  /// better view, and for all inner sides together.
  std::array<double, 4> outer_support = {};
  std::array<double, 4> inner_supports = {};
  double inner_support = 0.0;
  bool is_flat = true;  ///< Whether the outer sides lie in one plane, as far as the images tell.
  /// Whether the opening's edges were found in the plane of the outer ones.
  bool is_in_one_plane = false;

  double LeastSupport() const;  ///< Least of the outer sides.
  double LeastInnerSupport() const;
  double MeanSupport() const;
};

/// Counts for each side.
using SideCounts = std::array<int, 4>;

/// Number of places along the sides at which an edge was looked for, for each view.
struct PlaceCounts {
  std::vector<SideCounts> outer;
  std::vector<SideCounts> inner;
};

/// Stores in the fit the shares of these places whose edge the fit explains.
void CountSupport(const PlaceCounts& places, FrameFit& fit);

}  // namespace fenestra
