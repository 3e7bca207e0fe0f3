#pragma once

#include "vision/frame/edge_segment.h"

namespace fenestra {

/// The straight edges of an image at its own scale, neither rated (darkness 0) nor joined: maxima
/// of Sobel's derivative, found with sub-pixel resolution along rows (upright edges) or columns
/// (level ones), followed from one to the next and split where they bend (Ramer, Douglas and
/// Peucker; 0.8 px). A pixel's edge must be stronger than noise and, for its grey value, than
/// half of what `min_darkness` asks for.
EdgeSegments FollowEdges(const cv::Mat1b& image, const EdgeSegmentSettings& settings);

}  // namespace fenestra
