#pragma once

#include <Eigen/Core>
#include <array>
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

}  // namespace fenestra
