#include "vision/rgbd/paper/convex_hull.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace fenestra {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Half of a hull: the chain along `order` that turns only left.
std::vector<int> LeftTurningChain(const std::vector<Vector2d>& points,
                                  const std::vector<int>& order) {
  const auto at = [&points](int i) { return points[static_cast<size_t>(i)]; };
  std::vector<int> chain;
  for (const int i : order) {
    while (chain.size() >= 2) {
      const Vector2d last = at(chain.back());
      const Vector2d before = at(chain[chain.size() - 2]);
      if (Cross(last - before, at(i) - last) > 0.0) break;
      chain.pop_back();
    }
    chain.push_back(i);
  }
  return chain;
}

// Removes the points inside the quadrilateral of the outermost ones along the diagonals (S. G. Akl
// and G. T. Toussaint, "A fast convex hull algorithm", 1978). None of them is on the hull, and in a
// cloud they are the majority.
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

}  // namespace

std::vector<int> ConvexHull(const std::vector<Vector2d>& points) {
  std::vector<int> order = MaybeOnHull(points);
  const auto before = [&points](int i, int j) {
    const Vector2d& a = points[static_cast<size_t>(i)];
    const Vector2d& b = points[static_cast<size_t>(j)];
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(order.begin(), order.end(), before);
  if (order.size() < 3) return order;
  std::vector<int> hull = LeftTurningChain(points, order);
  std::reverse(order.begin(), order.end());
  const std::vector<int> back = LeftTurningChain(points, order);
  hull.insert(hull.end(), back.begin() + 1, back.end() - 1);
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
