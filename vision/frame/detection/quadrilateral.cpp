#include "vision/frame/detection/quadrilateral.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSmallestTolerance = 0.01;  // Share of the perimeter.
constexpr double kLargestTolerance = 0.10;
constexpr double kEndShare = 0.12;  // Share of a side that is left out at each end of a line fit.

struct Line {
  Vector2d point;
  Vector2d direction;  // Unit vector.
};

Vector2d ToEigen(const cv::Point& p) {
  return {p.x, p.y};
}

std::optional<Vector2d> Intersect(const Line& l, const Line& m) {
  const double sine = Cross(l.direction, m.direction);
  if (std::abs(sine) < 1e-3) return std::nullopt;
  const Vector2d p = l.point + Cross(m.point - l.point, m.direction) / sine * l.direction;
  if (!p.allFinite()) return std::nullopt;
  return p;
}

// sides[i] runs from corner i to corner i + 1.
std::optional<Quadrilateral> FromSides(const std::array<Line, 4>& sides) {
  Quadrilateral q;
  for (size_t i = 0; i < 4; ++i) {
    const auto corner = Intersect(sides[(i + 3) % 4], sides[i]);
    if (!corner) return std::nullopt;
    q[i] = *corner;
  }
  if (!IsConvex(q)) return std::nullopt;
  return q;
}

std::optional<Quadrilateral> FourCorners(const std::vector<cv::Point>& contour) {
  std::vector<cv::Point> hull;
  // OpenCV assumes a y axis that points up, so its "counter-clockwise" is clockwise as seen.
  cv::convexHull(contour, hull, false);
  const double perimeter = cv::arcLength(hull, true);
  std::vector<cv::Point> polygon;
  for (double share = kSmallestTolerance; share <= kLargestTolerance; share += 0.005) {
    cv::approxPolyDP(hull, polygon, share * perimeter, true);
    if (polygon.size() <= 4) break;
  }
  if (polygon.size() != 4) return std::nullopt;
  const auto first = std::min_element(
      polygon.begin(), polygon.end(),
      [](const cv::Point& a, const cv::Point& b) { return a.x + a.y < b.x + b.y; });
  std::rotate(polygon.begin(), first, polygon.end());
  Quadrilateral q;
  std::transform(polygon.begin(), polygon.end(), q.begin(), ToEigen);
  if (!IsConvex(q)) return std::nullopt;
  return q;
}

// Returns the contour's points near the side from p to q, or the side itself if there are too few.
Line FitSide(const std::vector<cv::Point>& contour, const Vector2d& p, const Vector2d& q) {
  const double length = (q - p).norm();
  const Vector2d along = (q - p) / length;
  const double reach_px = std::max(2.0, 0.05 * length);
  std::vector<cv::Point2f> near;
  for (const cv::Point& point : contour) {
    const Vector2d offset = ToEigen(point) - p;
    const double share = offset.dot(along) / length;
    if (share < kEndShare || share > 1.0 - kEndShare) continue;
    if (std::abs(Cross(along, offset)) <= reach_px) near.emplace_back(point);
  }
  if (near.size() < 4) return {p, along};
  cv::Vec4f fit;
  cv::fitLine(near, fit, cv::DIST_HUBER, 0.0, 0.01, 0.01);
  const Vector2d direction(fit[0], fit[1]);
  return {Vector2d(fit[2], fit[3]), direction.dot(along) < 0.0 ? -direction : direction};
}

double RelativeDifference(double a, double b) {
  return std::abs(a - b) / (0.5 * (a + b));
}

}  // namespace

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool IsConvex(const Quadrilateral& q) {
  for (size_t i = 0; i < 4; ++i) {
    const Vector2d& p = q[(i + 1) % 4];
    if (Cross(p - q[i], q[(i + 2) % 4] - p) <= 0.0) return false;
  }
  return true;
}

std::optional<Quadrilateral> FitQuadrilateral(const std::vector<cv::Point>& contour) {
  if (contour.size() < 4) return std::nullopt;
  const auto rough = FourCorners(contour);
  if (!rough) return std::nullopt;
  std::array<Line, 4> sides;
  for (size_t i = 0; i < 4; ++i) {
    sides[i] = FitSide(contour, (*rough)[i], (*rough)[(i + 1) % 4]);
  }
  return FromSides(sides);
}

std::optional<Quadrilateral> Inset(const Quadrilateral& quadrilateral, double half_px) {
  std::array<Line, 4> sides;
  for (size_t i = 0; i < 4; ++i) {
    const Vector2d along = (quadrilateral[(i + 1) % 4] - quadrilateral[i]).normalized();
    const Vector2d inwards(-along.y(), along.x());
    const double reach_px = half_px * (std::abs(inwards.x()) + std::abs(inwards.y()));
    sides[i] = {quadrilateral[i] + reach_px * inwards, along};
  }
  auto inset = FromSides(sides);
  // Beyond its centre a quadrilateral turns inside out but remains convex.
  for (size_t i = 0; inset && i < 4; ++i) {
    const Vector2d side = quadrilateral[(i + 1) % 4] - quadrilateral[i];
    if (side.dot((*inset)[(i + 1) % 4] - (*inset)[i]) <= 0.0) return std::nullopt;
  }
  return inset;
}

double Area(const Quadrilateral& q) {
  return 0.5 * (Cross(q[0], q[1]) + Cross(q[1], q[2]) + Cross(q[2], q[3]) + Cross(q[3], q[0]));
}

Vector2d At(const Quadrilateral& q, double s, double t) {
  return (1.0 - t) * ((1.0 - s) * q[0] + s * q[1]) + t * ((1.0 - s) * q[3] + s * q[2]);
}

WindowShape MeasureShape(const std::array<Vector3d, 4>& p_CV) {
  std::array<Vector3d, 4> side;
  for (size_t i = 0; i < 4; ++i) side[i] = p_CV[(i + 1) % 4] - p_CV[i];
  WindowShape shape;
  shape.width_m = 0.5 * (side[0].norm() + side[2].norm());
  shape.height_m = 0.5 * (side[1].norm() + side[3].norm());
  shape.taper = std::max(RelativeDifference(side[0].norm(), side[2].norm()),
                         RelativeDifference(side[1].norm(), side[3].norm()));
  for (size_t i = 0; i < 4; ++i) {
    const Vector3d& next = side[(i + 1) % 4];
    const double sine = std::abs(side[i].normalized().dot(next.normalized()));
    shape.skew_rad = std::max(shape.skew_rad, std::asin(std::min(1.0, sine)));
  }
  return shape;
}

}  // namespace fenestra
