#pragma once

#include <opencv2/core.hpp>

#include "core/observation.h"
#include "vision/rgbd/depth_points.h"
#include "vision/rgbd/frame_planes.h"

namespace fenestra {

/// What was used of a depth image: the wall green, what is off its plane red, the frame's front
/// yellow.
cv::Mat3b DrawDepthUse(const DepthImage& depth, const FramePlanes& planes,
                       const DepthPointReader& reader);

}  // namespace fenestra
