#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/random/random_stream.h"

namespace fenestra {

/// A plane n · p = d in frame K, with |n| = 1 and n pointing towards the camera (d < 0).
struct Plane {
  Eigen::Vector3d normal_K = -Eigen::Vector3d::UnitZ();
  double offset_m = 0.0;

  double SignedDistance(const Eigen::Vector3d& p_KQ) const { return normal_K.dot(p_KQ) - offset_m; }

  /// Coordinates (right, down) of the point's projection onto the plane, as the camera sees the
  /// plane, relative to the projection of the camera itself.
  Eigen::Vector2d Coordinates(const Eigen::Vector3d& p_KQ) const;
};

/// Largest distance of a point from the plane that it belongs to: fixed_m + per_z2 z², per_z2 in
/// 1/m, since the error of depth from triangulation grows with the square of the depth z.
struct PlaneTolerance {
  double fixed_m = 0.0;
  double per_z2 = 0.0;

  double At(double z_m) const { return fixed_m + per_z2 * z_m * z_m; }
};

/// Finds the plane that most points lie on: random sample consensus (Fischler & Bolles 1981) over
/// 100 triples, scored on at most 1000 evenly spaced points, followed by total least squares over
/// the points within the tolerance. If half of the points lie on the plane, no triple is free of
/// outliers with probability (1 − 1/8)^100 = 2e-6.
///
/// Returns nullopt if the points do not span a plane or if the plane contains the camera's centre.
std::optional<Plane> DominantPlane(const std::vector<Eigen::Vector3d>& points_K,
                                   const PlaneTolerance& tolerance, const RandomStream& triples);

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

/// Returns the indices of the points on the convex hull (Boost.Geometry). They run
/// counter-clockwise if y points up, i.e. clockwise as seen if y points down. Points in the
/// interior of a side are left out, also if only rounding lifts them off it.
std::vector<int> ConvexHull(const std::vector<Eigen::Vector2d>& points);

/// Signed area of a polygon, positive for the order that ConvexHull returns.
double SignedArea(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace fenestra
