#pragma once

#include <optional>
#include <vector>

#include "vision/rgbd/paper/dominant_plane.h"

namespace fenestra {

/// Overall shape of a cloud: its dominant plane, and the convex hull's area and the median depth of
/// its points on that plane. The hull of a frame is the frame's outer rectangle.
struct CloudShape {
  Plane plane;
  double hull_area_m2 = 0.0;
  double median_depth_m = 0.0;
  double inlier_share = 0.0;  ///< Share of the cloud's points that lie on its plane.
  double scatter_m = 0.0;     ///< Root mean square of their distances from it.
};

/// Returns nullopt if the points do not span a plane.
std::optional<CloudShape> ShapeOf(const std::vector<Eigen::Vector3d>& points_K,
                                  const PlaneTolerance& tolerance, const RandomStream& triples);

}  // namespace fenestra
