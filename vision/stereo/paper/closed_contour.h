#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace fenestra {

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
