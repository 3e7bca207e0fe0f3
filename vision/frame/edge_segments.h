#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/frame/edge_segment.h"

namespace fenestra {

/// Straight edges (edge_chains.h) that are clear enough. Pieces of one line are listed both apart
/// and joined across gaps, as what stands before a frame cuts its sides; a joined one must be as
/// clear in the gap. A picture of half the size adds what is straight only there: where a frame
/// stands back, its edge and the wall's beside it are a pixel or two apart, and the stronger of
/// both is now one and now the other.
EdgeSegments FindEdgeSegments(const cv::Mat1b& image, const EdgeSegmentSettings& settings);

/// The points where two lines meet, each given by two points; far away if they are parallel.
Eigen::Vector2d Meet(const EdgeSegment& a, const EdgeSegment& b);

}  // namespace fenestra
