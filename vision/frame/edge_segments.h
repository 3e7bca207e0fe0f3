#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/frame/darkness.h"

namespace fenestra {

/// The sides of a quadrilateral in the order of its corners: side i runs from corner i to i + 1.
enum class Side { kTop, kRight, kBottom, kLeft };
inline constexpr std::array<Side, 4> kAllSides = {Side::kTop, Side::kRight, Side::kBottom,
                                                  Side::kLeft};

/// A straight edge between dark and bright. Who walks from `from` to `to` has the dark on the
/// right, as on a walk clockwise around something dark (v points down).
struct EdgeSegment {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double darkness = 0.0;  ///< DarkOnTheRight.

  double Length() const { return (to - from).norm(); }
};

struct EdgeSegmentSettings {
  double min_length_px;
  double min_darkness;
  int most_per_side;  ///< The longest and clearest are kept.
  DarknessSettings darkness;
};

/// Straight edges by the side of a dark quadrilateral that each may be: a top side is dark below,
/// a left one dark on its right. An edge at 45° may be listed with both neighbours.
using EdgeSegments = std::array<std::vector<EdgeSegment>, 4>;

/// Straight edges (edge_chains.h) that are clear enough. Pieces of one line are listed both apart
/// and joined across gaps, as what stands before a frame cuts its sides; a joined one must be as
/// clear in the gap. A picture of half the size adds what is straight only there: where a frame
/// stands back, its edge and the wall's beside it are a pixel or two apart, and the stronger of
/// both is now one and now the other.
EdgeSegments FindEdgeSegments(const cv::Mat1b& image, const EdgeSegmentSettings& settings);

/// The points where two lines meet, each given by two points; far away if they are parallel.
Eigen::Vector2d Meet(const EdgeSegment& a, const EdgeSegment& b);

}  // namespace fenestra
