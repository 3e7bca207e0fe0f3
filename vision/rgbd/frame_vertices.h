#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/detection.h"
#include "vision/rgbd/cloud_shape.h"
#include "vision/rgbd/narf_key_points.h"

namespace fenestra {

/// What four points must be like to pass for the vertices of a frame.
struct VertexLimits {
  double min_area_fraction = 0.0;  ///< Area of the quadrilateral over that of the cloud's hull.
  double min_side_ratio = 0.0;     ///< Shortest over longest side.
};

/// Four key points, as indices in the order of their outline, and why they are no frame, if so.
/// Without four points in convex position, there is only a miss.
struct FrameVertices {
  std::optional<std::array<int, 4>> chosen;
  std::optional<Miss> miss;
  double area_fraction = 0.0;  ///< Of the chosen four, over that of the cloud's hull.
};

/// Takes the key points that lie on the cloud's plane, and of their feet on it the largest
/// quadrilateral.
FrameVertices ChooseFrameVertices(const std::vector<KeyPoint>& key_points, const CloudShape& shape,
                                  const PlaneTolerance& tolerance, const VertexLimits& limits);

}  // namespace fenestra
