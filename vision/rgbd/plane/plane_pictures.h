#pragma once

#include <opencv2/core.hpp>

#include "core/detection/observation.h"
#include "vision/rgbd/plane/depth_points.h"
#include "vision/rgbd/plane/frame_planes.h"

namespace fenestra {

/// Marks in a depth image the points that were used: the wall green, points off its plane red, and
/// the frame's front yellow.
cv::Mat3b DrawDepthUse(const DepthImage& depth, const FramePlanes& planes,
                       const DepthPointReader& reader);

}  // namespace fenestra
