#include "vision/rgbd/paper/frame_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/rgbd/paper/cloud_shape.h"

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

constexpr double kShrink = 0.5;
constexpr int kFractionBits = 8;  // Fractional bits of a pixel in cv::fillConvexPoly.
constexpr int kPlaces = 32;       // Places along a side.

// Tells at which pixels of the image the cloud has a point on the plane.
class OnPlane {
 public:
  OnPlane(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
          const PlaneTolerance& tolerance)
      : depth_m_(cloud.depth_m), camera_(camera), plane_(plane), tolerance_(tolerance) {}

  bool At(const cv::Point& pixel) const {
    if (!pixel.inside(cv::Rect({0, 0}, depth_m_.size()))) return false;
    const double z_m = depth_m_(pixel);
    if (!(z_m > 0.0)) return false;
    const auto ray_K = camera_.UnprojectRay({pixel.x, pixel.y});
    return ray_K && std::abs(plane_.SignedDistance(z_m * *ray_K)) <= tolerance_.At(z_m);
  }

  bool Near(const Eigen::Vector3d& p_KQ) const {
    const auto pixel = camera_.Project(p_KQ);
    if (!pixel) return false;
    const cv::Point middle(static_cast<int>(std::lround(pixel->x())),
                           static_cast<int>(std::lround(pixel->y())));
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        if (At(middle + cv::Point(du, dv))) return true;
      }
    }
    return false;
  }

 private:
  const cv::Mat1f& depth_m_;
  const CameraModel& camera_;
  const Plane& plane_;
  const PlaneTolerance& tolerance_;
};

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

double FilledShare(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
                   const PlaneTolerance& tolerance, const FourVertices& p_KV) {
  const Eigen::Vector3d middle = 0.25 * (p_KV[0] + p_KV[1] + p_KV[2] + p_KV[3]);
  std::vector<cv::Point> outline;
  for (const Eigen::Vector3d& p_KQ : p_KV) {
    const auto pixel = camera.Project(middle + kShrink * (p_KQ - middle));
    if (!pixel) return 0.0;
    const double scale = 1 << kFractionBits;
    outline.emplace_back(static_cast<int>(std::lround(scale * pixel->x())),
                         static_cast<int>(std::lround(scale * pixel->y())));
  }
  cv::Mat1b inside(cloud.depth_m.size(), uint8_t{0});
  cv::fillConvexPoly(inside, outline, 255, cv::LINE_8, kFractionBits);
  std::vector<cv::Point> pixels;
  cv::findNonZero(inside, pixels);
  const OnPlane on_plane(cloud, camera, plane, tolerance);
  const auto filled = std::count_if(pixels.begin(), pixels.end(),
                                    [&](const cv::Point& pixel) { return on_plane.At(pixel); });
  return pixels.empty() ? 0.0 : static_cast<double>(filled) / static_cast<double>(pixels.size());
}

double SeenShare(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
                 const PlaneTolerance& tolerance, const FourVertices& p_KV) {
  const OnPlane on_plane(cloud, camera, plane, tolerance);
  double least = 1.0;
  for (size_t i = 0; i < 4; ++i) {
    int seen = 0;
    for (int k = 0; k < kPlaces; ++k) {
      const double t = (k + 0.5) / kPlaces;
      if (on_plane.Near((1.0 - t) * p_KV[i] + t * p_KV[(i + 1) % 4])) ++seen;
    }
    least = std::min(least, seen / static_cast<double>(kPlaces));
  }
  return least;
}

}  // namespace fenestra
