#pragma once

#include <memory>

#include "core/geometry/camera_model.h"
#include "core/random/random_stream.h"
#include "sim/structured_light/disparity.h"
#include "sim/structured_light/dot_pattern.h"
#include "sim/structured_light/explained_depth.h"
#include "sim/structured_light/infrared_response.h"
#include "sim/structured_light/infrared_view.h"
#include "sim/structured_light/pattern_matching.h"
#include "sim/structured_light/sensor_unit.h"

namespace fenestra {

/// Depth from an infra-red image of the projected dots, as the sensor itself finds it.
class MatchedDepth {
 public:
  /// `depth`: the camera of the depth image's pixels, with `scale` infra-red pixels to each, along
  /// rows and columns (InfraredImageLayout).
  MatchedDepth(const InfraredOptions& infrared, const PatternMatchingOptions& matching,
               const CameraModel& depth, int scale, double baseline_m, const DisparityRange& range,
               const RollingShutter& shutter);

  /// The same with another camera, and with a unit's error of disparities.
  MatchedDepth WithUnit(const CameraModel& depth, const DisparityError& error) const;

  const InfraredResponse& response() const { return response_; }

  /// `unit_m`: the unit of the depth image. `shot`: the stream of this view's laser speckle;
  /// `image_noise`: that of this image's own noise.
  ExplainedDepth Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                         double unit_m, const RandomStream& shot,
                         const RandomStream& image_noise) const;

 private:
  PatternMatchingOptions matching_;
  DisparityRange range_;
  RollingShutter shutter_;
  DisparityError error_;
  CameraModel depth_camera_;
  InfraredImageLayout layout_;
  InfraredRays rays_;
  InfraredResponse response_;
  std::shared_ptr<const SampledPattern> pattern_;
  std::shared_ptr<const PatternMatcher> matcher_;
};

}  // namespace fenestra
