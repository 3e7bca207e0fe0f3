#pragma once

#include <opencv2/core.hpp>

#include "core/random/random_stream.h"
#include "sim/motion/rig_pose.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra {

/// A structured-light sensor before a large wall of one paint, alone or with a plate of the same
/// paint in front of it.
class WallSetup {
 public:
  struct Plate {
    double stand_off_m = 0.0;   ///< Distance of its middle from the wall.
    double half_width_m = 0.0;  ///< 0: no plate.
    double turn_rad = 0.0;      ///< About its upright middle.
  };

  WallSetup(const StructuredLightOptions& options, double reflectance_830nm, const Plate& plate,
            const RandomStream& stream);

  /// `wall_lx`: illuminance of the wall by daylight; `image`: images of other numbers have other
  /// noise and laser speckle.
  DepthImage See(const Viewpoint& viewpoint, double wall_lx = kIndoors_lx,
                 uint64_t image = 0) const;

  /// RMS of a pixel's depth over images around its mean, over pixels that always have a return [m].
  double TemporalNoise(const Viewpoint& viewpoint) const;

  /// A wall gets six tenths of the 300 lx that the sky gives on level ground.
  static constexpr double kIndoors_lx = 180.0;
  static constexpr double kWhite = 0.8;

 private:
  StructuredLightSensor sensor_;
  RayCaster caster_;
  RandomStream stream_;
  double wall_per_sky_;  ///< Illuminance of the wall's middle over that of level ground.
};

/// The middle half of an image.
cv::Rect MiddleOf(const cv::Mat& image);

/// Share of the pixels in the middle with a return.
double ValidShare(const DepthImage& depth);

/// RMS of depth around the plane that fits best, in the middle [m]; NaN without returns.
double PlaneResidual(const DepthImage& depth);

}  // namespace fenestra
