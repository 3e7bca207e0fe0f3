#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/random/random_stream.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra {

/// What is published of a structured-light sensor's depth, measured anew on simulated walls: in the
/// middle half of the image. Depth noise is around the plane that fits best; it has the fixed
/// pattern, the temporal noise and the quantisation in it.
struct DepthCurves {
  struct Distance {
    double z_m;
    double residual_m;  ///< RMS around the plane, 1° of tilt.
    double temporal_m;  ///< RMS over frames around each pixel's mean.
    double valid;       ///< Share of pixels with a return.
  };
  struct Incidence {
    double angle_rad;
    double residual_m;  ///< At 1.5 m.
    double valid;
  };
  /// An upright border: that of a plate at 1.5 m, 0.8 m before a wall, turned about its middle.
  struct Lateral {
    double angle_rad;
    double left_px;  ///< RMS around the line that fits best, in a 640-wide image.
    double right_px;
  };
  /// Between depths that occur.
  struct Step {
    double z_m;
    double open_ni_m;
    double microsoft_m;
  };
  struct Ambient {
    double wall_lx;  ///< Illuminance of the wall by daylight.
    double z_m;
    double valid;
  };
  struct Paint {
    double reflectance_830nm;
    double z_m;
    double valid;
  };
  /// Pixels without a return in rows across a plate, left and right of its middle; of a 640-wide
  /// image. Means over six plates.
  struct Shadow {
    double plate_m;
    double wall_m;
    double left_px;
    double right_px;
  };
  std::vector<Distance> by_distance;
  std::vector<Incidence> by_incidence;
  std::vector<Lateral> lateral;
  std::vector<Step> steps;
  std::vector<Ambient> by_ambient;
  std::vector<Paint> by_paint;
  std::vector<Shadow> shadows;
};

DepthCurves MeasureDepthCurves(const StructuredLightOptions& options, const RandomStream& stream);

/// The part of it on borders, by angle.
std::vector<DepthCurves::Lateral> MeasureLateral(const StructuredLightOptions& options,
                                                 const RandomStream& stream);

/// Where the share of valid pixels falls through one half, between the samples on either side, in
/// proportion of x's logarithm; NaN if it does not.
double HalfPoint(const std::vector<cv::Point2d>& x_and_share);

}  // namespace fenestra
