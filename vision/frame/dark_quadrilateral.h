#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/frame/darkness.h"
#include "vision/frame/edge_segment.h"
#include "vision/frame/quadrilateral.h"

namespace fenestra {

/// A quadrilateral of an image that is darker than what surrounds it.
struct DarkQuadrilateral {
  Quadrilateral corners_px;
  /// How clearly it stands out: mean over the sides of DarkInside, 0 to 1.
  double clarity = 0.0;
  double length_px = 0.0;  ///< Of the four edges together.
};

/// Which of two comes first: the clearer one, of equally clear ones (where all edges are as clear
/// as they can be) that with the longer edges. So a mirrored image has the same order.
template <typename Dark>
bool IsClearer(const Dark& a, const Dark& b) {
  return a.clarity != b.clarity ? a.clarity > b.clarity : a.length_px > b.length_px;
}

/// Convex quadrilaterals whose four sides are edges that reach near to their corners and are each
/// at least so dark on their inside, and IsDarkThroughout; the clearest first; of those that are
/// nearly the same only the clearest, and at most `most` of them.
std::vector<DarkQuadrilateral> FindDarkQuadrilaterals(const cv::Mat1b& image,
                                                      const EdgeSegments& segments,
                                                      const DarknessSettings& settings,
                                                      double min_darkness, size_t most);

}  // namespace fenestra
