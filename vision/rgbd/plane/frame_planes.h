#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/geometry/camera_model.h"
#include "vision/frame/adjustment/frame_adjustment.h"
#include "vision/frame/adjustment/frame_fit.h"
#include "vision/rgbd/plane/depth_around_frame.h"
#include "vision/rgbd/plane/depth_plane.h"

namespace fenestra {

struct FramePlaneSettings {
  DepthNoise noise;
  double clear_px;  ///< See DepthOf.
  double setback_m;
  double setback_sigma_m;
  bool fits_setback;  ///< Whether other observations in the fit determine the setback, as a known
                      ///< size does.
};

/// What the depth image tells about a frame.
struct FramePlanes {
  double setback_m = 0.0;        ///< How far the front is behind the wall, given or measured.
  double setback_sigma_m = 0.0;  ///< Standard deviation of setback_m, unless the planes contain it.
  std::vector<PlaneMeasurement> planes;  ///< The wall, and the frame's front if it has depth.
  FrameDepth points;
  DepthPlane wall;
};

/// Measures the wall around a frame, and the frame's front where it returns light. The front's
/// setback is that of the settings unless its own depth differs from it by more than four of its
/// standard deviations and 15 mm; the wall then determines only the front's tilt. If less than 0.6
/// of the front returns light, its own plane is not used, since noise has moved those returns. Down
/// to 0.3 their mean still determines the setback, to 2 cm. Points in the opening count as wall if
/// they lie in its plane, as they do where a frame is painted on the wall; unless a setback is
/// given, the frame is then flush whatever the settings allow for.
///
/// Miss: "no_depth" if there is too little depth on the wall; "open_border" if most depth between
/// the edges of the frame is far behind it, as through the pane of a bright frame; "stands_before"
/// if most depth within its edges is far in front of the plane, as that of a dark object on a desk;
/// "unexpected_setback" if the front is five standard deviations from where the settings place it.
///
/// `frame` must be accurate to about a pixel and have a border. `wall` is an initial guess.
std::variant<FramePlanes, Miss> MeasureFramePlanes(const std::vector<DepthPoint>& points,
                                                   const FrameRectangle& frame,
                                                   const DepthPlane& wall, const CameraModel& depth,
                                                   const FramePlaneSettings& settings);

/// Moves a frame `by_m` farther behind the wall and scales it so that a camera at p_LC sees it
/// unchanged.
FrameRectangle SetBack(const FrameRectangle& frame, const Eigen::Vector3d& p_LC, double by_m);

/// Corrects a frame for which all sides were assumed to be seen in the plane of its front. Sides
/// that the reveal hides from a camera at p_LC are moved to the edge that is seen instead, the edge
/// of the wall's face `setback_m` in front of the frame.
FrameRectangle WithHiddenSides(const FrameRectangle& frame, const Eigen::Vector3d& p_LC,
                               double setback_m);

/// Adds the uncertainty of the setback to the covariance of a frame's centroid: along the normal,
/// unless the fit contains it, and across it.
void AddSetback(const CameraView& view, bool is_fitted, const FramePlanes& planes, FrameFit& fit);

}  // namespace fenestra
