#pragma once

#include "vision/frame/detection/edge_segment.h"

namespace fenestra {

/// Finds the straight edges of an image at its own scale. They are neither rated (their darkness is
/// 0) nor joined. The maxima of the Sobel derivative are located with sub-pixel resolution along
/// rows (for vertical edges) or columns (for horizontal ones), linked from one row or column to the
/// next, and split where the chain bends (Ramer, Douglas and Peucker; 0.8 px). The edge at a pixel
/// must be stronger than noise and, relative to its grey value, stronger than half of what
/// `min_darkness` requires.
EdgeSegments FollowEdges(const cv::Mat1b& image, const EdgeSegmentSettings& settings);

}  // namespace fenestra
