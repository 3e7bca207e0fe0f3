#pragma once

#include <opencv2/core.hpp>

#include "vision/stereo/paper/closed_contour.h"

namespace fenestra {

/// Draws depth in false colours, near red and far blue; pixels without depth are black.
cv::Mat3b DrawDepth(const cv::Mat1f& depth_m, const DepthRange& range);

/// Places DetectEdges' result for a box of an image into an image of the given size.
cv::Mat1b DrawEdges(const cv::Mat1b& edges, const cv::Rect& box, const cv::Size& size);

}  // namespace fenestra
