#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/frame/detection/edge_segment.h"

namespace fenestra {

/// Finds the straight edges (edge_segment.h) of an image that are clear enough. Pieces of one line
/// are listed both separately and joined across gaps, since an object in front of a frame cuts its
/// sides; a joined segment must be as clear in the gap as elsewhere. An image of half the size adds
/// edges that are straight only at that scale: where a frame is recessed, its edge and the edge of
/// the wall are a pixel or two apart, and either of them may be the stronger one.
EdgeSegments FindEdgeSegments(const cv::Mat1b& image, const EdgeSegmentSettings& settings);

/// The intersection of the lines through two segments; a point far away if the lines are parallel.
Eigen::Vector2d Meet(const EdgeSegment& a, const EdgeSegment& b);

}  // namespace fenestra
