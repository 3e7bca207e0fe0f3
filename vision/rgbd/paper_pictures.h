#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/rgbd/dark_cloud.h"
#include "vision/rgbd/depth_registration.h"
#include "vision/rgbd/narf_key_points.h"

namespace fenestra {

/// The cloud's pixels green and dark pixels without depth red over the colour image.
cv::Mat3b DrawSegmentation(const RegisteredImages& images, const DarkCloud& cloud);

/// Size of DrawKeyPoints' picture over that of its range image.
inline constexpr int kKeyPointPictureScale = 3;

/// Key points as circles on the cloud's depth; the chosen four as a closed outline.
cv::Mat3b DrawKeyPoints(const cv::Mat1f& depth_m, const std::vector<KeyPoint>& key_points,
                        const std::optional<std::array<int, 4>>& chosen);

}  // namespace fenestra
