#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "vision/frame/adjustment/frame_fit.h"
#include "vision/frame/detection/dark_quadrilateral.h"

namespace fenestra {

/// Draws segments, coloured by the side that they may be, and quadrilaterals in magenta.
cv::Mat3b DrawSegments(const cv::Mat1b& image, const EdgeSegments& segments,
                       const std::vector<DarkQuadrilateral>& candidates);

/// Draws all views side by side, with edge points that the frame explains in green and the others
/// in red.
cv::Mat3b DrawEdgePoints(std::span<const CameraView> views, const FrameFit& fit);

}  // namespace fenestra
