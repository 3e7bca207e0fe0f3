#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/rgbd/paper/dark_cloud.h"
#include "vision/rgbd/paper/depth_registration.h"
#include "vision/rgbd/paper/narf_key_points.h"

namespace fenestra {

/// Marks in the colour image the cloud's pixels green and dark pixels without depth red.
cv::Mat3b DrawSegmentation(const RegisteredImages& images, const DarkCloud& cloud);

/// Scale of DrawKeyPoints' picture relative to the range image.
inline constexpr int kKeyPointPictureScale = 3;

/// Draws key points as circles on the cloud's depth, and the chosen four as a closed outline.
cv::Mat3b DrawKeyPoints(const cv::Mat1f& depth_m, const std::vector<KeyPoint>& key_points,
                        const std::optional<std::array<int, 4>>& chosen);

}  // namespace fenestra
