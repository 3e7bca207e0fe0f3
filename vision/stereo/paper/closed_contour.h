#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/stereo/paper/disparity_plane.h"

namespace fenestra {

/// Computes z = f B / d for every pixel [m]; 0 where there is no disparity.
cv::Mat1f DepthFromDisparity(const cv::Mat1f& disparity, const RectifiedCamera& camera);

struct DepthRange {
  double nearest_m;
  double farthest_m;
};

/// Converts a depth image to 8 bits for edge detection. Pixels without depth become 0 and the range
/// is mapped to 64 to 255, so that the step from no depth to the nearest depth is an edge as well.
cv::Mat1b ToEightBit(const cv::Mat1f& depth_m, const DepthRange& range);

/// The non-empty part of a depth image.
struct DepthPatch {
  cv::Rect box;
  cv::Mat1f depth_m;  ///< Depth within the box.

  /// Returns an image of the given size, which must contain the box.
  cv::Mat1f In(const cv::Size& size) const;
};

/// Closes the contour in a depth image (the paper's Fig. 5): the result has the depth of `plane` on
/// a ring of `thickness_px` along the inside of the convex `hull`, and at the matched pixels within
/// the hull that lie on the plane. It covers the bounding box of the hull, since there is nothing
/// outside it.
DepthPatch CloseGaps(const cv::Mat1f& disparity, const std::vector<cv::Point>& hull,
                     const DisparityPlane& plane, double plane_tolerance_px, int thickness_px,
                     const RectifiedCamera& camera);

struct CannyThresholds {
  double low_dn;
  double high_dn;
};

/// Detects edge pixels (255) in an 8-bit depth image: J. Canny, "A computational approach to edge
/// detection", PAMI 1986; cv::Canny with the 3 x 3 Sobel filter. The result is kEdgeRim_px larger
/// on every side, so that a contour along the image's border is an edge, too.
cv::Mat1b DetectEdges(const cv::Mat1b& depth_gray, const CannyThresholds& thresholds);
inline constexpr int kEdgeRim_px = 4;

/// Returns the edge curve that encloses the largest area, in pixels of the depth image, or nullopt
/// if there is none or if it is not closed, i.e. does not enclose nearly all of its own convex
/// hull.
///
/// Of the two pixels beside a step along a row or column, whose gradients are equal, Canny marks
/// the upper or left one, and the step itself is half a pixel further right and down. Add (½, ½) to
/// anything fitted to the contour. Such ties are rarer on slanted steps, where the correction may
/// be too large by up to half a pixel; this is well below the uncertainty of the ends of matched
/// bands.
std::optional<std::vector<cv::Point>> LargestClosedContour(const cv::Mat1b& edges);

}  // namespace fenestra
