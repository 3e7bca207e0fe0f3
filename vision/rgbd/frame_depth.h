#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/camera_model.h"
#include "vision/frame/frame_rectangle.h"
#include "vision/frame/quadrilateral.h"
#include "vision/rgbd/depth_plane.h"
#include "vision/rgbd/depth_points.h"

namespace fenestra {

/// Depth points around a quadrilateral of the colour image, freed of distortion: outside of it by
/// at least `clear_px` and at most a third of its size.
std::vector<DepthPoint> PointsAround(const std::vector<DepthPoint>& points,
                                     const Quadrilateral& corners_px, double clear_px);

/// The corners of a quadrilateral of the colour image on a plane in D that lies `setback_m` behind
/// the given one: where their rays meet it. nullopt where one does not, in front of both cameras.
std::optional<std::array<Eigen::Vector3d, 4>> CornersOnPlane(const Quadrilateral& corners_px,
                                                             const CameraModel& color,
                                                             const Pose& X_KD,
                                                             const Eigen::Vector3d& m,
                                                             double setback_m);

/// Whether a plane's depth is known to 3 % at all of these points: what stands beside a window, a
/// pipe for example, spans no plane.
bool IsKnownAt(const DepthPlane& plane, const std::array<Eigen::Vector3d, 4>& p_DV);

/// Depth points by where their rays meet a frame's front.
struct FrameDepth {
  std::vector<DepthPoint> wall;    ///< Around the frame.
  std::vector<DepthPoint> border;  ///< On the frame's front, between its edges.
  std::vector<DepthPoint> inside;  ///< In its opening.
  double border_pixels = 0.0;      ///< Rays that meet the front between its edges, returns or not.
  double inside_pixels = 0.0;      ///< The same in its opening.
};

struct DepthReach {
  /// Points nearer than this to an edge of the frame, in pixels of the depth camera, are left out,
  /// since their windows show both sides of it.
  double clear_px;
  double wall;  ///< How far the wall reaches from the frame, in longer sides of it.
  double read;  ///< Share of the pixels that were read.
};
FrameDepth DepthOf(const std::vector<DepthPoint>& points, const FrameRectangle& frame,
                   const CameraModel& depth, const DepthReach& reach);

}  // namespace fenestra
