#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "core/detection/stage_log.h"
#include "vision/stereo/rectification.h"

namespace fenestra {

/// Draws both images side by side with horizontal lines, on which corresponding points must have
/// the same height.
cv::Mat3b DrawRectifiedPair(const RectifiedPair& pair);

/// Views that project points in L into DrawRectifiedPair's picture. The first one is for its left
/// half, and for any picture of the rectified left camera; the second is for its right half.
std::array<PictureView, 2> RectifiedViews(const StereoRectification& rectification);

}  // namespace fenestra
