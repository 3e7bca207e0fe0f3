#include "vision/rgbd/paper/frame_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vision/rgbd/paper/convex_hull.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;

double CrossProduct(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

std::optional<Miss> ShapeFault(const std::vector<Eigen::Vector2d>& corners, double hull_area_m2,
                               const VertexLimits& limits) {
  const double area_fraction = SignedArea(corners) / hull_area_m2;
  if (area_fraction < limits.min_area_fraction) {
    return Miss{"implausible_shape",
                fmt::format("the four points cover {:.2f} of the cloud's hull; {} is needed",
                            area_fraction, limits.min_area_fraction)};
  }
  std::array<double, 4> sides{};
  for (size_t i = 0; i < 4; ++i) sides[i] = (corners[(i + 1) % 4] - corners[i]).norm();
  const auto [shortest, longest] = std::minmax_element(sides.begin(), sides.end());
  if (*shortest < limits.min_side_ratio * *longest) {
    return Miss{"implausible_shape",
                fmt::format("sides from {:.3f} m to {:.3f} m; a ratio of {} is needed", *shortest,
                            *longest, limits.min_side_ratio)};
  }
  return std::nullopt;
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
          const double twice_area = CrossProduct(at(c) - at(a), at(d) - at(b));
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
  // y points down in the image, so a positive area means clockwise order, from top left to top
  // right.
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

FrameVertices ChooseFrameVertices(const std::vector<KeyPoint>& key_points, const CloudShape& shape,
                                  const PlaneTolerance& tolerance, const VertexLimits& limits) {
  std::vector<int> on_plane;
  std::vector<Eigen::Vector2d> feet;
  for (size_t i = 0; i < key_points.size(); ++i) {
    const Eigen::Vector3d& p_KQ = key_points[i].p_KQ;
    if (std::abs(shape.plane.SignedDistance(p_KQ)) > tolerance.At(p_KQ.z())) continue;
    on_plane.push_back(static_cast<int>(i));
    feet.push_back(shape.plane.Coordinates(p_KQ));
  }
  const std::string counts = fmt::format("{} key points, {} of them on the plane of the cloud",
                                         key_points.size(), on_plane.size());
  if (on_plane.size() < 4) {
    return {.chosen = std::nullopt, .miss = Miss{"too_few_key_points", counts + "; 4 are needed"}};
  }
  auto chosen = LargestQuadrilateral(feet);
  if (!chosen) {
    return {.chosen = std::nullopt,
            .miss = Miss{"not_a_quadrilateral", counts + "; no four of them are convex"}};
  }
  std::vector<Eigen::Vector2d> corners;
  for (int& i : *chosen) {
    corners.push_back(feet[static_cast<size_t>(i)]);
    i = on_plane[static_cast<size_t>(i)];
  }
  return {.chosen = chosen,
          .miss = ShapeFault(corners, shape.hull_area_m2, limits),
          .area_fraction = SignedArea(corners) / shape.hull_area_m2};
}

}  // namespace fenestra
