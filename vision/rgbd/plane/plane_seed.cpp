#include "vision/rgbd/plane/plane_seed.h"

#include "vision/rgbd/plane/depth_around_frame.h"
#include "vision/rgbd/plane/frame_planes.h"

namespace fenestra {
namespace {

constexpr int kLeastPoints = 40;
constexpr double kLeastShare = 0.4;  // Least share of them on the plane.
constexpr uint64_t kSampleSeed = 1;  // The same samples for every image.

// Half of the points around a quadrilateral are enough to find their plane.
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
    const auto wall =
        FindDepthPlane(around, settings.noise, kLeastPoints, RandomStream(kSampleSeed));
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

}  // namespace fenestra
