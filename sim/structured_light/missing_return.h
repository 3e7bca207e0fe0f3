#pragma once

#include "core/geometry/camera_model.h"
#include "renderers/tracing/render_types.h"
#include "sim/structured_light/depth_frame.h"
#include "sim/structured_light/disparity_range.h"
#include "sim/structured_light/infrared_image.h"
#include "sim/structured_light/pattern_matching.h"

namespace fenestra {

/// Tells why a block was not matched, from what its central pixel sees.
class MissingReturn {
 public:
  /// Keeps references. `camera`: a pinhole; p_CP: the projector.
  MissingReturn(const InfraredOptions& infrared, const PatternMatchingOptions& matching,
                const DisparityRange& range, const CameraModel& camera, const Eigen::Vector3d& p_CP)
      : infrared_(infrared), matching_(matching), range_(range), camera_(camera), p_CP_(p_CP) {}

  /// The pixel must see a surface, and its block lie in the image.
  NoReturn Reason(const AovImages& aovs, cv::Point pixel) const;

 private:
  const InfraredOptions& infrared_;
  const PatternMatchingOptions& matching_;
  const DisparityRange& range_;
  const CameraModel& camera_;
  Eigen::Vector3d p_CP_;
};

}  // namespace fenestra
