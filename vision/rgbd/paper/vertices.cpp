#include "vision/rgbd/paper/vertices.h"

#include <algorithm>

#include "vision/rgbd/paper/convex_hull.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

std::optional<std::array<int, 4>> LargestQuadrilateral(const std::vector<Vector2d>& points) {
  const std::vector<int> hull = ConvexHull(points);
  if (hull.size() < 4) return std::nullopt;
  const auto at = [&](size_t i) -> const Vector2d& { return points[static_cast<size_t>(hull[i])]; };
  std::array<int, 4> best{};
  double largest = 0.0;
  for (size_t a = 0; a < hull.size(); ++a) {
    for (size_t b = a + 1; b < hull.size(); ++b) {
      for (size_t c = b + 1; c < hull.size(); ++c) {
        for (size_t d = c + 1; d < hull.size(); ++d) {
          const double twice_area = Cross(at(c) - at(a), at(d) - at(b));
          if (twice_area <= largest) continue;
          largest = twice_area;
          best = {hull[a], hull[b], hull[c], hull[d]};
        }
      }
    }
  }
  if (!(largest > 0.0)) return std::nullopt;
  return best;
}

FourVertices OrderedAsSeen(const FourVertices& p_CV) {
  std::vector<Vector2d> seen;
  for (const Eigen::Vector3d& p : p_CV) seen.push_back(p.head<2>() / p.z());
  FourVertices ordered = p_CV;
  // y points down in the image: a positive area goes round clockwise, from top left to top right.
  if (SignedArea(seen) < 0.0) {
    std::reverse(ordered.begin(), ordered.end());
    std::reverse(seen.begin(), seen.end());
  }
  const auto top_left =
      std::min_element(seen.begin(), seen.end(),
                       [](const Vector2d& a, const Vector2d& b) { return a.sum() < b.sum(); });
  std::rotate(ordered.begin(), ordered.begin() + (top_left - seen.begin()), ordered.end());
  return ordered;
}

}  // namespace fenestra
