#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/disparity_plane.h"

namespace fenestra {

/// z = f B / d of every pixel [m]; 0 where there is no disparity.
cv::Mat1f DepthFromDisparity(const cv::Mat1f& disparity, const RectifiedCamera& camera);

struct DepthRange {
  double nearest_m;
  double farthest_m;
};

/// 8-bit picture of a depth image for edge detection: no depth is 0 and the range is spread over
/// 64 to 255, so that the step from nothing to the nearest depth is an edge as well.
cv::Mat1b ToEightBit(const cv::Mat1f& depth_m, const DepthRange& range);

/// The part of a depth image that holds anything; 0 elsewhere.
struct DepthPatch {
  cv::Rect box;
  cv::Mat1f depth_m;  ///< Of the box.

  /// As an image of this size, in which the box must lie.
  cv::Mat1f In(const cv::Size& size) const;
};

/// The depth image with the contour closed (the paper's Fig. 5): the depth of `plane` on a ring of
/// `thickness_px` along the inside of the convex `hull`, and on the matched pixels within the hull
/// that lie on the plane. Within the box of the hull, as there is nothing outside.
DepthPatch CloseGaps(const cv::Mat1f& disparity, const std::vector<cv::Point>& hull,
                     const DisparityPlane& plane, double plane_tolerance_px, int thickness_px,
                     const RectifiedCamera& camera);

}  // namespace fenestra
