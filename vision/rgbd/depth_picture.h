#pragma once

#include <opencv2/core.hpp>

namespace fenestra {

/// Draws depth in false colours, from its smallest value in the image (red) to its largest (blue);
/// pixels without depth are black.
cv::Mat3b DrawDepth(const cv::Mat1f& depth_m);

}  // namespace fenestra
