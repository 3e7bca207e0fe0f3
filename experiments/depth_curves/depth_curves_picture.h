#pragma once

#include <opencv2/core.hpp>

#include "experiments/depth_curves/depth_curves.h"

namespace fenestra {

/// Six diagrams of both models and of the published laws: noise of a white wall over distance and
/// over incidence, lateral noise at a border, valid pixels in daylight and before black paint, and
/// the widths of shadows.
cv::Mat3b DepthCurvesPicture(const DepthCurves& parametric, const DepthCurves& speckle);

}  // namespace fenestra
