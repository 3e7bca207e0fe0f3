#pragma once

#include <opencv2/core.hpp>

namespace fenestra {

/// Converts a colour image to grey values that are linear in the light: the mean of its channels,
/// decoded from sRGB (IEC 61966-2-1), times a factor of at least 1 that brings the 98th percentile
/// to 200 DN, so that rounding adds little to the noise of a dark image; clipped at 255. An edge
/// between two areas is a blurred step in this image, but not in the encoded one.
cv::Mat1b LinearGrey(const cv::Mat3b& color);

}  // namespace fenestra
