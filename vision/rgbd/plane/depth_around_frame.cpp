#include "vision/rgbd/plane/depth_around_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRing = 1.0 / 3.0;
constexpr double kKnown = 0.03;

// Distance from the quadrilateral's farthest side, positive outside.
double DistanceOutside(const Quadrilateral& q, const std::array<Vector2d, 4>& outward,
                       const Vector2d& p) {
  double most = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 4; ++i) most = std::max(most, outward[i].dot(p - q[i]));
  return most;
}

// Numbers of pixels of a camera at the origin that see a frame's front.
struct PixelCounts {
  double border;  // At least `clear_px` inside the border's edges.
  double inside;  // At least `clear_px` inside the opening.
};
PixelCounts CountPixels(const FrameRectangle& frame, double f_px, double clear_px) {
  const double distance_m = frame.p_LO.norm();
  const double cosine = std::abs(frame.R_LO.col(2).dot(frame.p_LO)) / distance_m;
  const double pixels_per_m = f_px / distance_m;
  const double clear_m = clear_px / (pixels_per_m * std::max(0.2, cosine));
  const double width_m = std::max(0.0, frame.border_m - 2.0 * clear_m);
  const double length_m = 2.0 * (frame.width_m + frame.height_m) - 4.0 * frame.border_m;
  const double off_m = 2.0 * (frame.border_m + clear_m);
  const double opening_m2 =
      std::max(0.0, frame.width_m - off_m) * std::max(0.0, frame.height_m - off_m);
  const double pixels_per_m2 = cosine * pixels_per_m * pixels_per_m;
  return {width_m * length_m * pixels_per_m2, opening_m2 * pixels_per_m2};
}

}  // namespace

std::vector<DepthPoint> PointsAround(const std::vector<DepthPoint>& points,
                                     const Quadrilateral& corners_px, double clear_px) {
  std::array<Vector2d, 4> outward;
  Vector2d least = corners_px[0];
  Vector2d most = corners_px[0];
  for (size_t i = 0; i < 4; ++i) {
    const Vector2d along = (corners_px[(i + 1) % 4] - corners_px[i]).normalized();
    outward[i] = {along.y(), -along.x()};
    least = least.cwiseMin(corners_px[i]);
    most = most.cwiseMax(corners_px[i]);
  }
  const double reach_px = clear_px + kRing * (most - least).maxCoeff();
  std::vector<DepthPoint> around;
  for (const DepthPoint& point : points) {
    const Vector2d p = point.seen_px.cast<double>();
    if ((p - least).minCoeff() < -reach_px || (most - p).minCoeff() < -reach_px) continue;
    const double distance_px = DistanceOutside(corners_px, outward, p);
    if (distance_px > clear_px && distance_px < reach_px) around.push_back(point);
  }
  return around;
}

std::optional<std::array<Vector3d, 4>> CornersOnPlane(const Quadrilateral& corners_px,
                                                      const CameraModel& color, const Pose& X_KD,
                                                      const Vector3d& m, double setback_m) {
  const Pose X_DK = X_KD.inverse();
  const CameraParameters& k = color.parameters();
  // n·p = q with n towards the camera.
  const Vector3d normal = -m.normalized();
  const double q = -1.0 / m.norm() - setback_m;
  std::array<Vector3d, 4> p_DV;
  for (size_t i = 0; i < 4; ++i) {
    const Vector3d ray_K((corners_px[i].x() - k.cx_px) / k.fx_px,
                         (corners_px[i].y() - k.cy_px) / k.fy_px, 1.0);
    const Vector3d ray_D = X_DK.rotation() * ray_K;
    const double depth_m = (q - normal.dot(X_DK.translation())) / normal.dot(ray_D);
    if (!(depth_m > 0.0) || !std::isfinite(depth_m)) return std::nullopt;
    p_DV[i] = depth_m * ray_D + X_DK.translation();
    if (!(p_DV[i].z() > 0.0)) return std::nullopt;
  }
  return p_DV;
}

bool IsKnownAt(const DepthPlane& plane, const std::array<Vector3d, 4>& p_DV) {
  return std::all_of(p_DV.begin(), p_DV.end(),
                     [&](const Vector3d& p_DQ) { return plane.RelativeSigmaAt(p_DQ) < kKnown; });
}

FrameDepth DepthOf(const std::vector<DepthPoint>& points, const FrameRectangle& frame,
                   const CameraModel& depth, const DepthReach& reach) {
  const Vector3d normal = frame.R_LO.col(2);
  const double q = normal.dot(frame.p_LO);
  const double f_px = depth.parameters().fx_px;
  const Vector2d outer = 0.5 * Vector2d(frame.width_m, frame.height_m);
  const double reach_m = reach.wall * 2.0 * outer.maxCoeff();
  FrameDepth found;
  const PixelCounts pixels = CountPixels(frame, f_px, reach.clear_px);
  found.border_pixels = reach.read * pixels.border;
  found.inside_pixels = reach.read * pixels.inside;
  for (const DepthPoint& point : points) {
    const double depth_m = q / normal.dot(point.ray_D);
    if (!(depth_m > 0.0)) continue;
    const Vector3d p_O = frame.R_LO.transpose() * (depth_m * point.ray_D - frame.p_LO);
    const Vector2d beyond = p_O.head<2>().cwiseAbs() - outer;
    const double outside_m = beyond.maxCoeff();
    if (outside_m > reach_m) continue;
    // Largest distance on the front that corresponds to this many pixels.
    const double cosine = std::abs(normal.dot(point.ray_D)) / point.ray_D.norm();
    const double clear_m = reach.clear_px * depth_m / (f_px * std::max(0.2, cosine));
    if (outside_m > clear_m) {
      found.wall.push_back(point);
    } else if (outside_m < -clear_m && outside_m > clear_m - frame.border_m) {
      found.border.push_back(point);
    } else if (outside_m < -clear_m - frame.border_m) {
      found.inside.push_back(point);
    }
  }
  return found;
}

}  // namespace fenestra
