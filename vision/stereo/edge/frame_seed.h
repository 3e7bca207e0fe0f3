#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/frame/detection/dark_quadrilateral.h"
#include "vision/frame/detection/edge_segment.h"
#include "vision/frame/model/frame_limits.h"
#include "vision/frame/model/frame_rectangle.h"
#include "vision/stereo/rectification.h"

namespace fenestra {

/// A dark quadrilateral seen in both views that may be a rectangle in space.
struct FrameSeed {
  std::array<Eigen::Vector3d, 4> p_FV;  ///< Corners in the frame of the rectified left camera.
  double clarity = 0.0;                 ///< Mean of DarkInside over both views.
  double length_px = 0.0;               ///< Total length of the edges in both views.
};

/// Matches the sides of a quadrilateral in the rectified left image to edges in the right one. The
/// disparity of a corner is that of its vertical side. Every choice of edges in the right image
/// that yields a plausible rectangle in space and is dark in the right image, too, is a seed. A
/// corner's row is the mean of both views, so that the views are treated alike, or that of the left
/// view if the right one has no matching horizontal edge.
std::vector<FrameSeed> FindSeeds(const DarkQuadrilateral& left, const EdgeSegments& right_segments,
                                 const cv::Mat1b& right_image, const RectifiedCamera& camera,
                                 const FrameLimits& limits, const DarknessSettings& darkness);

/// Returns at most `most` seeds, the clearest first; of several that nearly coincide, only the
/// clearest.
std::vector<FrameSeed> ClearestSeeds(std::vector<FrameSeed> seeds, size_t most);

}  // namespace fenestra
