#pragma once

#include <opencv2/core.hpp>

#include "vision/stereo/depth_image.h"
#include "vision/stereo/rectification.h"

namespace fenestra {

/// Both images side by side with horizontal lines: the same point must be at the same height.
cv::Mat3b DrawRectifiedPair(const RectifiedPair& pair);

/// Depth in false colours, near red, far blue; no depth black.
cv::Mat3b DrawDepth(const cv::Mat1f& depth_m, const DepthRange& range);

}  // namespace fenestra
