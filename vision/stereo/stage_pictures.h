#pragma once

#include <opencv2/core.hpp>

#include "vision/stereo/depth_image.h"

namespace fenestra {

/// Depth in false colours, near red, far blue; no depth black.
cv::Mat3b DrawDepth(const cv::Mat1f& depth_m, const DepthRange& range);

/// DetectEdges' result for a box of an image, in an image of this size.
cv::Mat1b DrawEdges(const cv::Mat1b& edges, const cv::Rect& box, const cv::Size& size);

}  // namespace fenestra
