#include "vision/rgbd/paper/cloud_shape.h"

#include <algorithm>
#include <cmath>

#include "vision/rgbd/paper/convex_hull.h"

namespace fenestra {

std::optional<CloudShape> ShapeOf(const std::vector<Eigen::Vector3d>& points_K,
                                  const PlaneTolerance& tolerance, const RandomStream& triples) {
  const auto plane = DominantPlane(points_K, tolerance, triples);
  if (!plane) return std::nullopt;
  std::vector<Eigen::Vector2d> feet;
  std::vector<double> depths_m;
  double squares_m2 = 0.0;
  for (const Eigen::Vector3d& p_KQ : points_K) {
    const double distance_m = plane->SignedDistance(p_KQ);
    if (std::abs(distance_m) <= tolerance.At(p_KQ.z())) {
      squares_m2 += distance_m * distance_m;
      feet.push_back(plane->Coordinates(p_KQ));
      depths_m.push_back(p_KQ.z());
    }
  }
  std::vector<Eigen::Vector2d> hull;
  for (const int i : ConvexHull(feet)) hull.push_back(feet[static_cast<size_t>(i)]);
  const double area_m2 = SignedArea(hull);
  if (!(area_m2 > 0.0)) return std::nullopt;
  const auto middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
  std::nth_element(depths_m.begin(), middle, depths_m.end());
  const double count = static_cast<double>(depths_m.size());
  return CloudShape{.plane = *plane,
                    .hull_area_m2 = area_m2,
                    .median_depth_m = *middle,
                    .inlier_share = count / static_cast<double>(points_K.size()),
                    .scatter_m = std::sqrt(squares_m2 / count)};
}

}  // namespace fenestra
