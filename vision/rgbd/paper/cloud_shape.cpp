#include "vision/rgbd/paper/cloud_shape.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/geometry/algorithms/convex_hull.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/register/point.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <boost/geometry/strategies/agnostic/hull_graham_andrew.hpp>
#include <boost/geometry/strategies/cartesian/side_by_triangle.hpp>
#include <cmath>
#include <iterator>
#include <numeric>

namespace fenestra {
namespace {

using Eigen::Vector2d;

using Points = std::vector<Eigen::Vector3d>;

constexpr int kTriples = 100;
constexpr size_t kScoredPoints = 1000;
// A plane closer to the camera's centre than this is seen edge-on.
constexpr double kClosestPlaneM = 1e-6;

std::optional<Plane> Oriented(const Eigen::Vector3d& normal_K, const Eigen::Vector3d& p_KQ) {
  const double offset_m = normal_K.dot(p_KQ);
  if (!normal_K.allFinite() || !(std::abs(offset_m) > kClosestPlaneM)) return std::nullopt;
  if (offset_m < 0.0) return Plane{normal_K, offset_m};
  return Plane{-normal_K, -offset_m};
}

std::optional<Plane> Through(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (!(normal.norm() > 1e-12)) return std::nullopt;
  return Oriented(normal.normalized(), a);
}

bool IsOn(const Plane& plane, const PlaneTolerance& tolerance, const Eigen::Vector3d& p_KQ) {
  return std::abs(plane.SignedDistance(p_KQ)) <= tolerance.At(p_KQ.z());
}

Points Inliers(const Points& points_K, const Plane& plane, const PlaneTolerance& tolerance) {
  Points inliers;
  std::copy_if(points_K.begin(), points_K.end(), std::back_inserter(inliers),
               [&](const Eigen::Vector3d& p_KQ) { return IsOn(plane, tolerance, p_KQ); });
  return inliers;
}

std::optional<Plane> LeastSquares(const Points& points_K) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p_KQ : points_K) mean += p_KQ;
  mean /= static_cast<double>(points_K.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p_KQ : points_K) {
    scatter += (p_KQ - mean) * (p_KQ - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  // Points on a line have two vanishing eigenvalues.
  if (!(solver.eigenvalues()(1) > 1e-12 * solver.eigenvalues()(2))) return std::nullopt;
  return Oriented(solver.eigenvectors().col(0), mean);
}

Points EvenlySpaced(const Points& points_K) {
  const size_t stride = (points_K.size() + kScoredPoints - 1) / kScoredPoints;
  Points spaced;
  for (size_t i = 0; i < points_K.size(); i += std::max<size_t>(stride, 1)) {
    spaced.push_back(points_K[i]);
  }
  return spaced;
}

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Removes the points inside the quadrilateral of the outermost ones along the diagonals (S. G. Akl
// and G. T. Toussaint, "A fast convex hull algorithm", 1978). None of them is on the hull, and in a
// cloud they are the majority, while Boost takes half a microsecond for each.
std::vector<int> MaybeOnHull(const std::vector<Vector2d>& points) {
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  if (points.size() < 64) return all;
  const std::array<Vector2d, 4> outwards = {Vector2d(-1, -1), {1, -1}, {1, 1}, {-1, 1}};
  std::array<Vector2d, 4> corner;
  for (size_t k = 0; k < 4; ++k) {
    corner[k] = *std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
      return outwards[k].dot(a) < outwards[k].dot(b);
    });
  }
  std::erase_if(all, [&](int i) {
    const Vector2d& p = points[static_cast<size_t>(i)];
    for (size_t k = 0; k < 4; ++k) {
      // The margin keeps rounding from deciding.
      const Vector2d side = corner[(k + 1) % 4] - corner[k];
      if (!(Cross(side, p - corner[k]) > 1e-9 * side.squaredNorm())) return false;
    }
    return true;
  });
  return all;
}

// A point that knows its place in the cloud.
struct IndexedPoint {
  double x;
  double y;
  int index;
};

}  // namespace
}  // namespace fenestra

BOOST_GEOMETRY_REGISTER_POINT_2D(fenestra::IndexedPoint, double, cs::cartesian, x, y)

namespace fenestra {

Eigen::Vector2d Plane::Coordinates(const Eigen::Vector3d& p_KQ) const {
  // The first axis is the camera's +x axis projected onto the plane, or its +y axis if the plane is
  // seen along x.
  const bool along_x = std::abs(normal_K.x()) > 0.9;
  const Eigen::Vector3d axis = along_x ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d right = (axis - normal_K.dot(axis) * normal_K).normalized();
  const Eigen::Vector3d down = -normal_K.cross(right);
  return {right.dot(p_KQ), down.dot(p_KQ)};
}

std::optional<Plane> DominantPlane(const Points& points_K, const PlaneTolerance& tolerance,
                                   const RandomStream& triples) {
  const Points scored = EvenlySpaced(points_K);
  if (scored.size() < 3) return std::nullopt;
  const auto draw = [&](int index) -> const Eigen::Vector3d& {
    const double u = triples.Uniform(static_cast<uint64_t>(index));
    return scored[static_cast<size_t>(u * static_cast<double>(scored.size()))];
  };
  std::vector<double> tolerances_m;
  for (const Eigen::Vector3d& p_KQ : scored) tolerances_m.push_back(tolerance.At(p_KQ.z()));
  std::optional<Plane> best;
  int most = 0;
  for (int i = 0; i < kTriples; ++i) {
    const auto plane = Through(draw(3 * i), draw(3 * i + 1), draw(3 * i + 2));
    if (!plane) continue;
    int inliers = 0;
    for (size_t j = 0; j < scored.size(); ++j) {
      inliers += std::abs(plane->SignedDistance(scored[j])) <= tolerances_m[j] ? 1 : 0;
    }
    if (inliers > most) {
      most = inliers;
      best = plane;
    }
  }
  if (!best) return std::nullopt;
  return LeastSquares(Inliers(points_K, *best, tolerance));
}

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

std::vector<int> ConvexHull(const std::vector<Vector2d>& points) {
  if (points.empty()) return {};
  boost::geometry::model::multi_point<IndexedPoint> indexed;
  for (const int i : MaybeOnHull(points)) {
    const Vector2d& point = points[static_cast<size_t>(i)];
    indexed.push_back({point.x(), point.y(), i});
  }
  boost::geometry::model::ring<IndexedPoint, /*ClockWise=*/false, /*Closed=*/false> ring;
  boost::geometry::convex_hull(indexed, ring);
  std::vector<int> hull;
  for (const IndexedPoint& point : ring) hull.push_back(point.index);
  // Boost repeats the first of fewer than three corners.
  while (hull.size() > 1 && hull.back() == hull.front()) hull.pop_back();
  return hull;
}

double SignedArea(const std::vector<Vector2d>& polygon) {
  double twice_area = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    twice_area += Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return 0.5 * twice_area;
}

}  // namespace fenestra
