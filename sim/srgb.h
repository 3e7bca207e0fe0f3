#pragma once

#include <opencv2/core.hpp>

namespace fenestra {

/// Encodes linear values as sRGB (IEC 61966-2-1): 8 bits, rounded to nearest; values outside [0, 1]
/// are clipped.
///
///     v = 12.92 x                    x ≤ 0.0031308
///     v = 1.055 x^(1/2.4) − 0.055    else
double SrgbFromLinear(double linear);
cv::Mat1b EncodeSrgb(const cv::Mat1f& linear);

}  // namespace fenestra
