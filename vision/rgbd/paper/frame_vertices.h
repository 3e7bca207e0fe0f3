#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/detection/detection.h"
#include "vision/rgbd/paper/cloud_shape.h"
#include "vision/rgbd/paper/narf_key_points.h"

namespace fenestra {

/// Requirements on four points to be accepted as the vertices of a frame.
struct VertexLimits {
  double min_area_fraction = 0.0;  ///< Area of the quadrilateral over that of the cloud's hull.
  double min_side_ratio = 0.0;     ///< Shortest over longest side.
};

/// Four key points, as indices in the order of their outline, and the reason why they are not a
/// frame if they are not. If no four points are in convex position, there is only a miss.
struct FrameVertices {
  std::optional<std::array<int, 4>> chosen;
  std::optional<Miss> miss;
  double area_fraction = 0.0;  ///< Area of the chosen four over that of the cloud's hull.
};

/// Projects the key points that lie close to the cloud's plane onto it and chooses the four that
/// span the largest quadrilateral there.
FrameVertices ChooseFrameVertices(const std::vector<KeyPoint>& key_points, const CloudShape& shape,
                                  const PlaneTolerance& tolerance, const VertexLimits& limits);

}  // namespace fenestra
