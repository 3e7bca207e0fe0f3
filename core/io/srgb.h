#pragma once

#include <opencv2/core.hpp>

namespace fenestra {

/// The transfer curve of sRGB (IEC 61966-2-1) between linear light x and encoded values v, both in
/// [0, 1] and in double precision:
///
///     v = 12.92 x                    x ≤ 0.0031308
///     v = 1.055 x^(1/2.4) − 0.055    else
double LinearFromSrgb(double encoded);

/// The inverse of LinearFromSrgb; clips values outside [0, 1].
double SrgbFromLinear(double linear);

/// The slope dv/dx of the curve, for the propagation of noise.
double SrgbSlope(double linear);

/// Encodes linear values in 8 bits, rounded to the nearest code; clips values outside [0, 1].
cv::Mat1b EncodeSrgb(const cv::Mat1f& linear);

}  // namespace fenestra
