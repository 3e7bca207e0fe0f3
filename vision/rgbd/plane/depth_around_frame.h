#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/geometry/camera_model.h"
#include "vision/frame/detection/quadrilateral.h"
#include "vision/frame/model/frame_rectangle.h"
#include "vision/rgbd/plane/depth_plane.h"
#include "vision/rgbd/plane/depth_points.h"

namespace fenestra {

/// Returns the depth points around a quadrilateral of the undistorted colour image: those outside
/// it by at least `clear_px` and at most a third of its size.
std::vector<DepthPoint> PointsAround(const std::vector<DepthPoint>& points,
                                     const Quadrilateral& corners_px, double clear_px);

/// Intersects the rays of a colour image's quadrilateral with the plane in D that lies `setback_m`
/// behind the plane `m`. Returns nullopt if a ray does not meet it in front of both cameras.
std::optional<std::array<Eigen::Vector3d, 4>> CornersOnPlane(const Quadrilateral& corners_px,
                                                             const CameraModel& color,
                                                             const Pose& X_KD,
                                                             const Eigen::Vector3d& m,
                                                             double setback_m);

/// Tells whether a plane's depth is known to 3 % at all of these points. It is not if the plane was
/// fitted to something narrow beside a window, such as a pipe.
bool IsKnownAt(const DepthPlane& plane, const std::array<Eigen::Vector3d, 4>& p_DV);

/// Depth points, grouped by where their rays meet the plane of a frame's front.
struct FrameDepth {
  std::vector<DepthPoint> wall;    ///< Around the frame.
  std::vector<DepthPoint> border;  ///< On the frame's front, between its edges.
  std::vector<DepthPoint> inside;  ///< In its opening.
  double border_pixels =
      0.0;  ///< Number of rays that meet the front between its edges, with or without a depth.
  double inside_pixels =
      0.0;  ///< Number of rays that meet the plane in the opening, with or without a depth.
};

struct DepthReach {
  /// Points nearer than this to an edge of the frame, in pixels of the depth camera, are left out,
  /// since their blocks cover both sides of the edge.
  double clear_px;
  double wall;  ///< How far the wall reaches from the frame, in units of the frame's longer side.
  double read;  ///< Share of the pixels that were read.
};
FrameDepth DepthOf(const std::vector<DepthPoint>& points, const FrameRectangle& frame,
                   const CameraModel& depth, const DepthReach& reach);

}  // namespace fenestra
