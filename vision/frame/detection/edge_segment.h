#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/frame/detection/darkness.h"

namespace fenestra {

/// The sides of a quadrilateral in the order of its corners: side i runs from corner i to i + 1.
enum class Side { kTop, kRight, kBottom, kLeft };
inline constexpr std::array<Side, 4> kAllSides = {Side::kTop, Side::kRight, Side::kBottom,
                                                  Side::kLeft};

/// A straight edge between dark and bright. It is oriented with the dark side on the right, i.e.
/// clockwise around a dark region (v points down).
struct EdgeSegment {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double darkness = 0.0;  ///< See DarkOnTheRight.

  double Length() const { return (to - from).norm(); }
};

struct EdgeSegmentSettings {
  double min_length_px;
  double min_darkness;
  int most_per_side;  ///< Only the longest and clearest are kept.
  DarknessSettings darkness;
};

/// Straight edges, grouped by the side of a dark quadrilateral that each of them may be: a top side
/// is dark below it, a left side is dark on its right. An edge at 45° may be listed under both
/// neighbouring sides.
using EdgeSegments = std::array<std::vector<EdgeSegment>, 4>;

/// Finds the straight edges of an image at its own scale. They are neither rated (their darkness is
/// 0) nor joined. The maxima of the Sobel derivative are located with sub-pixel resolution along
/// rows (for vertical edges) or columns (for horizontal ones), linked from one row or column to the
/// next, and split where the chain bends (Ramer, Douglas and Peucker; 0.8 px). The edge at a pixel
/// must be stronger than noise and, relative to its grey value, stronger than half of what
/// `min_darkness` requires.
EdgeSegments FollowEdges(const cv::Mat1b& image, const EdgeSegmentSettings& settings);

}  // namespace fenestra
