#pragma once

#include "core/detection/depth_reprojection.h"
#include "renderers/ray_caster.h"
#include "sim/structured_light/missing_return.h"

namespace fenestra {

/// Registers depth images to the colour camera, as drivers do: every pixel is reprojected to where
/// the colour camera sees it. What only the colour camera sees becomes a hole at the foreground's
/// edge.
class DepthRegistrar {
 public:
  /// `depth`: the camera D of the depth images; `registered`: that of the result, at the colour
  /// camera K.
  DepthRegistrar(const CameraModel& depth, const Pose& X_KD, const CameraModel& registered);

  /// The reasons of holes are those of the depth pixels that should have been reprojected there.
  ExplainedDepth Register(const ExplainedDepth& depth, const RayCaster& caster,
                          const Lighting& lighting, const Pose& X_WK) const;

 private:
  NoReturn Reason(const ExplainedDepth& depth, cv::Point pixel, float z_m) const;

  CameraModel depth_;
  Pose X_DK_;
  RayGrid rays_;  ///< The rays of the registered camera.
  DepthReprojection reprojection_;
};

}  // namespace fenestra
