#include "vision/rgbd/plane_seed.h"

#include "vision/rgbd/frame_depth.h"

namespace fenestra {
namespace {

constexpr int kLeastPoints = 40;
constexpr double kLeastShare = 0.4;  // Of them, on the plane.
constexpr uint64_t kTriples = 1;     // The same samples for every image.

// Of the points around a quadrilateral one in two is enough to find their plane.
std::vector<DepthPoint> EverySecondRow(const std::vector<DepthPoint>& points) {
  std::vector<DepthPoint> rows;
  rows.reserve(points.size());
  int row = -1;
  bool keep = false;
  for (const DepthPoint& point : points) {
    if (point.pixel.y != row) keep = !keep;
    row = point.pixel.y;
    if (keep) rows.push_back(point);
  }
  return rows;
}

}  // namespace

PlaneSeeds FindPlaneSeeds(const std::vector<DarkQuadrilateral>& candidates,
                          const std::vector<DepthPoint>& points, const CameraModel& color,
                          const Pose& X_KD, const PlaneSeedSettings& settings) {
  const std::vector<DepthPoint> sparse = EverySecondRow(points);
  PlaneSeeds found;
  for (const DarkQuadrilateral& candidate : candidates) {
    const auto around = PointsAround(sparse, candidate.corners_px, settings.clear_px);
    const auto wall = FindDepthPlane(around, settings.noise, kLeastPoints, RandomStream(kTriples));
    if (!wall || wall->inliers < kLeastShare * static_cast<double>(around.size())) {
      ++found.without_plane;
      continue;
    }
    const auto corners =
        CornersOnPlane(candidate.corners_px, color, X_KD, wall->m, settings.setback_m);
    if (!corners || !AreCornersOfFrame(*corners, settings.limits)) continue;
    if (!IsKnownAt(*wall, *corners)) {
      ++found.without_plane;
      continue;
    }
    found.seeds.push_back(
        {.frame = WithHiddenSides(FrameRectangle::FromCorners(*corners),
                                  X_KD.inverse().translation(), settings.setback_m),
         .wall = *wall,
         .clarity = candidate.clarity});
  }
  return found;
}

FrameRectangle WithHiddenSides(const FrameRectangle& frame, const Eigen::Vector3d& p_LC,
                               double setback_m) {
  FrameRectangle moved = frame;
  if (!(setback_m > 0.0)) return moved;
  const Eigen::Vector3d p_OC = frame.R_LO.transpose() * (p_LC - frame.p_LO);
  const double share = setback_m / p_OC.z();  // Of the way from the front to the camera.
  std::array<double, 4> reach_m = {};         // Of each side from the middle.
  for (size_t i = 0; i < 4; ++i) {
    const double sign = i < 2 ? 1.0 : -1.0;  // Top and right; bottom and left.
    const bool level = i % 2 == 0;
    const double at_m = 0.5 * (level ? frame.height_m : frame.width_m);
    const double camera_m = sign * (level ? p_OC.y() : p_OC.x());
    const bool is_hidden = camera_m > at_m;
    reach_m[i] = is_hidden ? at_m + share * (camera_m - at_m) : at_m;
    moved.outer_relief_m[i] = is_hidden ? setback_m : 0.0;
  }
  moved.height_m = reach_m[0] + reach_m[2];
  moved.width_m = reach_m[1] + reach_m[3];
  moved.p_LO += 0.5 * (reach_m[1] - reach_m[3]) * frame.R_LO.col(0) +
                0.5 * (reach_m[0] - reach_m[2]) * frame.R_LO.col(1);
  return moved;
}

}  // namespace fenestra
