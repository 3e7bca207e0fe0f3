#pragma once

#include <vector>

#include "vision/frame/detection/dark_quadrilateral.h"
#include "vision/frame/model/frame_limits.h"
#include "vision/rgbd/plane/depth_plane.h"

namespace fenestra {

/// A dark quadrilateral of the colour image that is a rectangle on the plane around it.
struct PlaneSeed {
  FrameRectangle frame;  ///< In D.
  DepthPlane wall;
  double clarity = 0.0;
};

struct PlaneSeedSettings {
  FrameLimits limits;
  DepthNoise noise;
  double setback_m;  ///< How far the frame's front is behind the plane around it.
  double clear_px;  ///< Gap between a quadrilateral and the depth points around it [colour pixels].
};

struct PlaneSeeds {
  std::vector<PlaneSeed> seeds;  ///< In the order of their candidates.
  int without_plane = 0;         ///< Number of candidates without enough depth around them.
};

/// Finds the candidates that are rectangles on the plane around them. `color` is the colour camera
/// without its distortion. A candidate counts as without a plane if fewer than 40 points around it,
/// or fewer than 40 % of them, lie on one plane, or if the plane's depth is uncertain at its
/// corners (IsKnownAt). It is dropped if its corners, where their rays meet that plane, do not form
/// a rectangle within the limits. Sides that the reveal would hide are moved to the wall's edge
/// (WithHiddenSides).
PlaneSeeds FindPlaneSeeds(const std::vector<DarkQuadrilateral>& candidates,
                          const std::vector<DepthPoint>& points, const CameraModel& color,
                          const Pose& X_KD, const PlaneSeedSettings& settings);

}  // namespace fenestra
