#pragma once

#include <opencv2/core.hpp>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"
#include "renderers/tracing/render_types.h"

namespace fenestra {

/// Per-pixel truth of the scored camera C of one observation: the true left camera (stereo) or the
/// depth camera (RGB-D).
struct TruthImages {
  CameraModel camera;
  Pose X_WC;
  /// `sees_point` is the view of the right camera (stereo) or of the projector (RGB-D).
  AovImages aovs;
  Band band;           ///< What `radiance` measures.
  cv::Mat1f radiance;  ///< Before lens and sensor; see Band.
  /// What a matcher should find [px]: (u_L − u_R, v_L − v_R) of the surface point between the true,
  /// unrectified cameras (stereo), or f b / z between infra-red camera and projector (RGB-D). NaN
  /// where nothing is hit or the point projects outside the right image.
  cv::Mat2f disparity_px;
};

}  // namespace fenestra
