#pragma once

#include <optional>
#include <vector>

#include "vision/rgbd/dominant_plane.h"

namespace fenestra {

/// What a cloud looks like as a whole: its dominant plane, and of its points on that plane the area
/// of the convex hull and the median depth. A frame's hull is the frame's outer rectangle.
struct CloudShape {
  Plane plane;
  double hull_area_m2 = 0.0;
  double median_depth_m = 0.0;
  double inlier_share = 0.0;  ///< Of the cloud's points, on its plane.
  double scatter_m = 0.0;     ///< Root mean square of their distances from it.
};

/// nullopt if the points do not span a plane.
std::optional<CloudShape> ShapeOf(const std::vector<Eigen::Vector3d>& points_K,
                                  const PlaneTolerance& tolerance, const RandomStream& triples);

}  // namespace fenestra
