#pragma once

#include <opencv2/core.hpp>

namespace fenestra {

/// Light that a colour image shows, in grey values: the mean of its channels freed from sRGB's
/// encoding (IEC 61966-2-1), times the factor, at least 1, that brings its 98th percentile to
/// 200 DN, so that rounding adds little to a dark image's noise; clipped at 255. An edge between
/// two areas is a blurred step in this image, but not in the encoded one.
cv::Mat1b LinearGrey(const cv::Mat3b& color);

}  // namespace fenestra
