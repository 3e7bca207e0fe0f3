#pragma once

#include <Eigen/Core>
#include <vector>

namespace fenestra {

/// Indices of the points on the convex hull, counter-clockwise where y points up (clockwise as seen
/// where y points down); points inside its sides are left out. Andrew's monotone chain.
std::vector<int> ConvexHull(const std::vector<Eigen::Vector2d>& points);

/// Signed area of a polygon, positive in the order of ConvexHull.
double SignedArea(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace fenestra
