#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/frame/detection/darkness.h"
#include "vision/frame/detection/edge_segment.h"
#include "vision/frame/detection/quadrilateral.h"

namespace fenestra {

/// A quadrilateral in an image that is darker than its surroundings.
struct DarkQuadrilateral {
  Quadrilateral corners_px;
  /// How clearly it stands out, from 0 to 1: see DarkInside.
  double clarity = 0.0;
  double length_px = 0.0;  ///< Total length of the four edges.
};

/// Orders candidates: the clearer one comes first. Of equally clear ones, which occur where all
/// edges are as clear as they can be, the one with the longer edges comes first, so that a mirrored
/// image gives the same order.
template <typename Dark>
bool IsClearer(const Dark& a, const Dark& b) {
  return a.clarity != b.clarity ? a.clarity > b.clarity : a.length_px > b.length_px;
}

/// Finds convex quadrilaterals whose four sides are edges that reach close to the corners and are
/// each at least `min_darkness` dark on the inside, and for which IsDarkThroughout holds. Returns
/// at most `most` of them, the clearest first; of several that nearly coincide, only the clearest
/// is returned. Every combination of segments that meet at all four corners is tried, with the
/// first 256 horizontal segments of each side, so the clearest must come first.
std::vector<DarkQuadrilateral> FindDarkQuadrilaterals(const cv::Mat1b& image,
                                                      const EdgeSegments& segments,
                                                      const DarknessSettings& settings,
                                                      double min_darkness, size_t most);

}  // namespace fenestra
