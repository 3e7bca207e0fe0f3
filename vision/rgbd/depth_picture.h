#pragma once

#include <opencv2/core.hpp>

namespace fenestra {

/// Depth from its smallest (red) to its largest value (blue) in the image; black where there is
/// none.
cv::Mat3b DrawDepth(const cv::Mat1f& depth_m);

}  // namespace fenestra
