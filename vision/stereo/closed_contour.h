#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace fenestra {

struct CannyThresholds {
  double low_dn;
  double high_dn;
};

/// Edge pixels (255) of an 8-bit depth image: J. Canny, "A computational approach to edge
/// detection", PAMI 1986; cv::Canny with the 3 x 3 Sobel filter. The result is kEdgeRim_px larger
/// on every side, so that a contour along the image's border is an edge, too.
cv::Mat1b DetectEdges(const cv::Mat1b& depth_gray, const CannyThresholds& thresholds);
inline constexpr int kEdgeRim_px = 4;

/// The edge curve that encloses the largest area, if it is closed: it must enclose nearly all of
/// its own convex hull. In pixels of the depth image. nullopt if there is none.
///
/// Of the two pixels beside a step along a row or column, whose gradients are equal, Canny marks
/// the upper or left one, and the step itself is half a pixel further right and down: add (½, ½) to
/// what is fitted to the contour. On slanted steps such ties are rarer, so that the correction may
/// be too much by up to half a pixel, which is far below what the ends of matched bands are worth.
std::optional<std::vector<cv::Point>> LargestClosedContour(const cv::Mat1b& edges);

}  // namespace fenestra
