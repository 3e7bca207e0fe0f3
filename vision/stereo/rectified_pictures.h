#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "core/stage_log.h"
#include "vision/stereo/rectification.h"

namespace fenestra {

/// Both images side by side with horizontal lines: the same point must be at the same height.
cv::Mat3b DrawRectifiedPair(const RectifiedPair& pair);

/// How points in L appear in DrawRectifiedPair's picture: on its left half, which is also how they
/// appear in any picture of the rectified left camera, and on its right half.
std::array<PictureView, 2> RectifiedViews(const StereoRectification& rectification);

}  // namespace fenestra
