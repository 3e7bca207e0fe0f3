#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/frame/dark_quadrilateral.h"
#include "vision/frame/edge_segment.h"
#include "vision/frame/frame_limits.h"
#include "vision/frame/frame_rectangle.h"
#include "vision/stereo/rectified_camera.h"

namespace fenestra {

/// A dark quadrilateral in both views that may be a rectangle in space.
struct FrameSeed {
  std::array<Eigen::Vector3d, 4> p_FV;  ///< In the rectified left camera.
  double clarity = 0.0;                 ///< Mean of both views' DarkInside.
  double length_px = 0.0;               ///< Of both views' edges together.
};

/// Finds the sides of a quadrilateral of the rectified left image again in the right one. Each
/// corner's disparity is that of its upright side; every choice of edges of the right image that
/// makes a plausible rectangle in space of them, and that is dark in the right image too, is a
/// seed. Corners are in the mean of both views' rows, so that neither view comes first; where the
/// right one has no such level edge, in the left one's.
std::vector<FrameSeed> FindSeeds(const DarkQuadrilateral& left, const EdgeSegments& right_segments,
                                 const cv::Mat1b& right_image, const RectifiedCamera& camera,
                                 const FrameLimits& limits, const DarknessSettings& darkness);

/// The clearest first; of those that are nearly the same only the clearest, and at most `most`.
std::vector<FrameSeed> ClearestSeeds(std::vector<FrameSeed> seeds, size_t most);

}  // namespace fenestra
