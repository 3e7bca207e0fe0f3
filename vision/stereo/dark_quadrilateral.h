#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/edge_segments.h"
#include "vision/stereo/quadrilateral.h"

namespace fenestra {

/// A quadrilateral of an image that is darker than what surrounds it.
struct DarkQuadrilateral {
  Quadrilateral corners_px;
  /// How clearly it stands out: mean over the sides of DarkInside, 0 to 1.
  double clarity = 0.0;
};

struct DarknessSettings {
  double black_dn;  ///< Grey value without light.
  double noise_dn;  ///< What is darker by less than three times this is not darker.
  double reach_px;  ///< Grey values are compared up to here on either side of an edge.
};

/// How clearly a quadrilateral's sides part dark within from bright without: mean over its sides
/// and places along them of ln(bright / dark) / ln 4, at most 1, 0 where it is not darker. Places
/// outside the image count as 0.
double DarkInside(const cv::Mat1b& image, const Quadrilateral& corners_px,
                  const DarknessSettings& settings);

/// Convex quadrilaterals whose four sides are edges that reach near to their corners, the clearest
/// first; of those that are nearly the same only the clearest, and at most `most` of them.
std::vector<DarkQuadrilateral> FindDarkQuadrilaterals(const cv::Mat1b& image,
                                                      const EdgeSegments& segments,
                                                      const DarknessSettings& settings,
                                                      size_t most);

}  // namespace fenestra
