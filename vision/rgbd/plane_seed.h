#pragma once

#include <vector>

#include "vision/frame/dark_quadrilateral.h"
#include "vision/frame/frame_limits.h"
#include "vision/rgbd/depth_plane.h"

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
  double setback_m;  ///< Of the frame's front behind the plane around it.
  double clear_px;   ///< Between a quadrilateral and the depth points around it [colour pixels].
};

struct PlaneSeeds {
  std::vector<PlaneSeed> seeds;  ///< In the order of their candidates.
  int without_plane = 0;         ///< Candidates without enough depth around them.
};

/// `color`: the colour camera, freed of distortion.
PlaneSeeds FindPlaneSeeds(const std::vector<DarkQuadrilateral>& candidates,
                          const std::vector<DepthPoint>& points, const CameraModel& color,
                          const Pose& X_KD, const PlaneSeedSettings& settings);

}  // namespace fenestra
