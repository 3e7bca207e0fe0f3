#include "vision/rgbd/plane/frame_planes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "vision/frame/setback/settle_depth.h"

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kLeastWall = 100;
constexpr int kLeastFront = 30;
constexpr double kWallReach = 1.5;  // In longer sides of the frame, on each side of it.
constexpr double kFree_m = 1.0;     // Standard deviation of an unknown offset.
constexpr double kOtherwise = 4.0;
constexpr double kOtherwise_m = 0.015;
// Points this far behind or in front of the front are not part of a frame.
constexpr double kOff_m = 0.15;
constexpr double kOffSigmas = 6.0;
constexpr int kLeastOff = 15;
constexpr double kLeastOpen = 0.3;  // Share of the pixels between the edges.
// Share of the pixels within the frame's edges. An object in front of the frame may hide a part of
// it.
constexpr double kLeastBefore = 0.6;
// Share of the front's pixels. If black paint returns fewer, these are the ones that noise has
// moved.
constexpr double kLeastReturns = 0.6;
// Down to this share, the mean of the returns is accurate to kMovedSigma_m.
constexpr double kFewReturns = 0.3;
constexpr double kMovedSigma_m = 0.02;
// A frame this far from where the settings place it is something else.
constexpr double kUnexpected = 5.0;
constexpr double kNominalSigma_m = 0.01;
constexpr double kInlier = 3.5;
constexpr double kInPlane = 0.9;  // Share of the points of a surface.

// Returns the plane parallel to this one and `setback_m` behind it.
Vector3d Behind(const Vector3d& m, double setback_m) {
  return m.normalized() / (1.0 / m.norm() + setback_m);
}

PlaneMeasurement WallMeasurement(const DepthPlane& wall, double setback_m, double sigma_m) {
  // m = n/(n·p + relief), so that dm/drelief = |m| m, since n points towards the camera.
  const Vector3d by_setback = wall.m.norm() * wall.m;
  const Matrix3d covariance =
      wall.information.inverse() + sigma_m * sigma_m * by_setback * by_setback.transpose();
  return {.m = wall.m, .information = covariance.inverse(), .relief_m = setback_m};
}

// Setback of the front behind the wall, measured by the depth between the frame's edges.
struct Offset {
  double setback_m;
  double sigma_m;
};
std::optional<Offset> MeasureOffset(const std::vector<DepthPoint>& front, const DepthPlane& wall,
                                    const DepthNoise& noise) {
  if (front.size() < kLeastFront) return std::nullopt;
  std::vector<double> behind;
  double inverse_depth = 0.0;
  for (const DepthPoint& point : front) {
    behind.push_back(-wall.Distance(point));
    inverse_depth += point.inverse_depth / static_cast<double>(front.size());
  }
  const auto middle = behind.begin() + static_cast<std::ptrdiff_t>(behind.size() / 2);
  std::nth_element(behind.begin(), middle, behind.end());
  const double independent = std::max(1.0, static_cast<double>(front.size()) / noise.window_points);
  // The variance of a median is π/2 times that of a mean.
  const double sigma_m =
      wall.sigma / (inverse_depth * inverse_depth) * std::sqrt(1.57 / independent);
  return Offset{*middle, sigma_m};
}

// Tells whether points outside the wall lie in its plane.
bool AreInPlane(const std::vector<DepthPoint>& points, const DepthPlane& wall,
                const DepthNoise& noise) {
  const auto offset = MeasureOffset(points, wall, noise);
  if (!offset) return false;
  Vector3d middle = Vector3d::Zero();
  double inverse_depth = 0.0;
  int near = 0;
  for (const DepthPoint& point : points) {
    middle += point.ray_D / static_cast<double>(points.size());
    inverse_depth += point.inverse_depth / static_cast<double>(points.size());
    const double off = point.inverse_depth - wall.m.dot(point.ray_D);
    if (std::abs(off) < kInlier * wall.sigma) ++near;
  }
  if (near < kInPlane * static_cast<double>(points.size())) return false;
  const double of_wall_m =
      std::sqrt(middle.dot(wall.information.inverse() * middle)) / std::pow(inverse_depth, 2);
  return std::abs(offset->setback_m) < kInlier * std::hypot(offset->sigma_m, of_wall_m);
}

double OffLimit(const DepthPoint& point, const DepthPlane& wall) {
  return std::max(kOff_m, kOffSigmas * wall.sigma / std::pow(point.inverse_depth, 2));
}

bool IsOpen(const FrameDepth& depth, const DepthPlane& wall, double setback_m) {
  const auto behind =
      std::count_if(depth.border.begin(), depth.border.end(), [&](const DepthPoint& point) {
        return -wall.Distance(point) - setback_m > OffLimit(point, wall);
      });
  return behind >= kLeastOff && 2 * behind > static_cast<int>(depth.border.size()) &&
         static_cast<double>(behind) > kLeastOpen * depth.border_pixels;
}

bool StandsBefore(const FrameDepth& depth, const DepthPlane& wall) {
  int before = 0;
  for (const auto* points : {&depth.border, &depth.inside}) {
    before += static_cast<int>(std::count_if(
        points->begin(), points->end(),
        [&](const DepthPoint& point) { return wall.Distance(point) > OffLimit(point, wall); }));
  }
  return before >= kLeastOff && before > kLeastBefore * (depth.border_pixels + depth.inside_pixels);
}

// Depth of a frame's front.
struct Front {
  bool is_whole = false;
  std::optional<Offset> offset;
};

Front SeeFront(const FrameDepth& points, const DepthPlane& wall, const DepthNoise& noise) {
  const double share =
      static_cast<double>(points.border.size()) / std::max(1.0, points.border_pixels);
  Front front{.is_whole = share > kLeastReturns, .offset = {}};
  if (share > kFewReturns) front.offset = MeasureOffset(points.border, wall, noise);
  if (front.offset && !front.is_whole) {
    front.offset->sigma_m = std::hypot(front.offset->sigma_m, kMovedSigma_m);
  }
  return front;
}

// The wall's points and plane, with the points in the opening if they lie in that plane.
struct Wall {
  std::vector<DepthPoint> points;
  DepthPlane plane;
  bool has_opening;
};

std::optional<Wall> MeasureWall(const FrameDepth& points, const FrameRectangle& frame,
                                const DepthPlane& start, const DepthNoise& noise) {
  auto plane = MeasureDepthPlane(points.wall, start.m, noise, kLeastWall);
  if (!plane || !IsKnownAt(*plane, frame.ToEstimate().p_CV)) return std::nullopt;
  if (!AreInPlane(points.inside, *plane, noise)) return Wall{points.wall, *plane, false};
  std::vector<DepthPoint> all = points.wall;
  all.insert(all.end(), points.inside.begin(), points.inside.end());
  if (const auto both = MeasureDepthPlane(all, plane->m, noise, kLeastWall)) plane = both;
  return Wall{std::move(all), *plane, true};
}

// The setback of the front, its standard deviation, and the one with which the wall enters a fit.
struct SetbackFound {
  double setback_m;
  double sigma_m;
  double fitted_sigma_m;
};

std::variant<SetbackFound, Miss> ChooseSetback(const Front& seen, bool is_painted,
                                               const FramePlaneSettings& settings) {
  SetbackFound found{.setback_m = settings.setback_m,
                     .sigma_m = is_painted ? 0.0 : settings.setback_sigma_m,
                     .fitted_sigma_m = 0.0};
  if (settings.fits_setback) found.fitted_sigma_m = found.sigma_m;
  if (!seen.offset) return found;
  const double off_m = std::abs(seen.offset->setback_m - settings.setback_m);
  const double sigma_m = std::hypot(found.sigma_m, seen.offset->sigma_m, kNominalSigma_m);
  if (!is_painted && off_m > kUnexpected * sigma_m) {
    return Miss{"unexpected_setback",
                fmt::format("what is seen between the frame's edges is {:.3f} m behind the wall, "
                            "not {:.3f} m",
                            seen.offset->setback_m, settings.setback_m)};
  }
  // A few returns are better than none.
  const double surely_m = seen.is_whole ? kOtherwise * seen.offset->sigma_m : 0.0;
  if (!is_painted && off_m > std::max(kOtherwise_m, surely_m)) {
    found.setback_m = seen.offset->setback_m;
    if (seen.is_whole) found.fitted_sigma_m = kFree_m;
  }
  found.sigma_m = std::min(found.sigma_m, seen.offset->sigma_m);
  return found;
}

}  // namespace

std::variant<FramePlanes, Miss> MeasureFramePlanes(const std::vector<DepthPoint>& points,
                                                   const FrameRectangle& frame,
                                                   const DepthPlane& wall, const CameraModel& depth,
                                                   const FramePlaneSettings& settings) {
  FramePlanes found;
  found.points =
      DepthOf(points, frame, depth,
              {.clear_px = settings.clear_px,
               .wall = kWallReach,
               .read = settings.noise.window_points / std::pow(settings.noise.window_px, 2)});
  auto wall_found = MeasureWall(found.points, frame, wall, settings.noise);
  if (!wall_found) {
    return Miss{"no_depth", fmt::format("{} depth pixels of the wall around the frame",
                                        found.points.wall.size())};
  }
  found.points.wall = std::move(wall_found->points);
  found.wall = wall_found->plane;
  if (IsOpen(found.points, found.wall, settings.setback_m)) {
    return Miss{"open_border", "what is seen between the frame's edges is far behind them"};
  }
  if (StandsBefore(found.points, found.wall)) {
    return Miss{"stands_before", "what is seen within the frame's edges is far before the wall"};
  }
  const Front seen = SeeFront(found.points, found.wall, settings.noise);
  // A frame with wall within it is painted on the wall.
  const bool is_painted = wall_found->has_opening && settings.setback_m == 0.0;
  const auto setback = ChooseSetback(seen, is_painted, settings);
  if (const Miss* miss = std::get_if<Miss>(&setback)) return *miss;
  const auto& [setback_m, sigma_m, fitted_sigma_m] = std::get<SetbackFound>(setback);
  found.setback_m = setback_m;
  found.setback_sigma_m = sigma_m;
  found.planes.push_back(WallMeasurement(found.wall, found.setback_m, fitted_sigma_m));
  if (!seen.is_whole) return found;
  const auto own = MeasureDepthPlane(found.points.border, Behind(found.wall.m, found.setback_m),
                                     settings.noise, kLeastFront);
  if (own) found.planes.push_back({.m = own->m, .information = own->information, .relief_m = 0.0});
  return found;
}

FrameRectangle SetBack(const FrameRectangle& frame, const Eigen::Vector3d& p_LC, double by_m) {
  const double distance_m = -frame.R_LO.col(2).dot(frame.p_LO - p_LC);
  const double factor = (distance_m + by_m) / distance_m;
  FrameRectangle moved = frame;
  moved.p_LO = p_LC + factor * (frame.p_LO - p_LC);
  moved.width_m *= factor;
  moved.height_m *= factor;
  moved.border_m *= factor;
  return moved;
}

FrameRectangle WithHiddenSides(const FrameRectangle& frame, const Eigen::Vector3d& p_LC,
                               double setback_m) {
  FrameRectangle moved = frame;
  if (!(setback_m > 0.0)) return moved;
  const Eigen::Vector3d p_OC = frame.R_LO.transpose() * (p_LC - frame.p_LO);
  const double share = setback_m / p_OC.z();  // Share of the way from the front to the camera.
  std::array<double, 4> reach_m = {};         // Distance of each side from the middle.
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

void AddSetback(const CameraView& view, bool is_fitted, const FramePlanes& planes, FrameFit& fit) {
  const double depth_m = std::max(std::abs(planes.setback_m), planes.setback_sigma_m);
  if (!(depth_m > 0.0)) return;
  AddParallax(std::span(&view, 1), {.upright_m = depth_m, .level_m = depth_m}, fit);
  if (is_fitted || planes.planes.size() > 1) return;
  const Eigen::Vector3d off = planes.setback_sigma_m * fit.adjustment.frame.R_LO.col(2);
  fit.adjustment.covariance.block<3, 3>(3, 3) += off * off.transpose();
}

}  // namespace fenestra
