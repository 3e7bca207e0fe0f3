#pragma once

#include <Eigen/Core>
#include <vector>

namespace fenestra {

/// Returns the indices of the points on the convex hull, found by Andrew's monotone chain. They run
/// counter-clockwise if y points up, i.e. clockwise as seen if y points down. Points in the
/// interior of a side are left out.
std::vector<int> ConvexHull(const std::vector<Eigen::Vector2d>& points);

/// Signed area of a polygon, positive for the order that ConvexHull returns.
double SignedArea(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace fenestra
