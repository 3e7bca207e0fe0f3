#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/camera_model.h"
#include "vision/frame/frame_adjustment.h"
#include "vision/rgbd/depth_plane.h"
#include "vision/rgbd/frame_depth.h"

namespace fenestra {

struct FramePlaneSettings {
  DepthNoise noise;
  double clear_px;  ///< See DepthOf.
  double setback_m;
  double setback_sigma_m;
  bool fits_setback;  ///< Whether anything else tells it in the fit, as a known size does.
};

/// What depth knows of a frame.
struct FramePlanes {
  double setback_m = 0.0;                ///< Of the front behind the wall, given or measured.
  double setback_sigma_m = 0.0;          ///< Of that, where it is not in the planes.
  std::vector<PlaneMeasurement> planes;  ///< The wall; the frame's front, where it has depth.
  FrameDepth points;
  DepthPlane wall;
};

/// Measures the wall around a frame, and the frame's front where it returns light. The front is
/// where the settings say, unless its own depth is there and says otherwise by four standard
/// deviations of its own and 15 mm; then the wall tells the front's tilt only. Where less than 0.6
/// of the front returns light, its own plane is not used: those are the returns that noise has
/// moved. Down to 0.3 their mean still tells the setback, to 2 cm. What is seen in the opening
/// counts as wall if it is in its plane, as where a frame is painted on it; then, unless a setback
/// is given, the frame is flush whatever the settings allow for.
///
/// Miss: "no_depth" if there is too little of the wall; "open_border" if most of what is seen
/// between the edges of the frame is far behind it, as through the pane of a bright frame;
/// "stands_before" if most of what is within its edges is far before the plane, as something dark
/// is that lies on a desk; "unexpected_setback" if the front is seen five standard deviations from
/// where the settings say.
///
/// `frame`: right to a pixel or so, with a border. `wall`: a first guess.
std::variant<FramePlanes, Miss> MeasureFramePlanes(const std::vector<DepthPoint>& points,
                                                   const FrameRectangle& frame,
                                                   const DepthPlane& wall, const CameraModel& depth,
                                                   const FramePlaneSettings& settings);

}  // namespace fenestra
