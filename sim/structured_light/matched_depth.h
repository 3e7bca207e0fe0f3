#pragma once

#include "core/geometry/camera_model.h"
#include "core/random/random_stream.h"
#include "sim/structured_light/disparity.h"
#include "sim/structured_light/dot_pattern.h"
#include "sim/structured_light/explained_depth.h"
#include "sim/structured_light/infrared_response.h"
#include "sim/structured_light/infrared_view.h"
#include "sim/structured_light/pattern_matching.h"

namespace fenestra {

/// Depth from an infra-red image of the projected dots, as the sensor itself finds it.
class MatchedDepth {
 public:
  /// `depth`: the camera of the depth image's pixels. The infra-red image is `scale` times as
  /// wide and high; depth pixel (u, v) is its pixel (scale u, scale v).
  MatchedDepth(const InfraredOptions& infrared, const PatternMatchingOptions& matching,
               const CameraModel& depth, int scale, double baseline_m, const DisparityRange& range,
               const RollingShutter& shutter);

  /// `unit_m`: the unit of the depth image. `shot`: the stream of this view's laser speckle;
  /// `image_noise`: that of this image's own noise.
  ExplainedDepth Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                         double unit_m, const RandomStream& shot,
                         const RandomStream& image_noise) const;

 private:
  PatternMatchingOptions matching_;
  DisparityRange range_;
  int scale_;
  cv::Size depth_size_;
  InfraredRays rays_;
  InfraredResponse response_;
  SampledPattern pattern_;
  PatternMatcher matcher_;
};

}  // namespace fenestra
