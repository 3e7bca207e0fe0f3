#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/random_stream.h"
#include "sim/structured_light_sensor.h"

namespace fenestra {

/// What is published of a structured-light sensor's depth, measured anew on simulated walls: the
/// middle half of the image, wall lit by a sky alone. Depth noise is around the plane that fits
/// best; it has the fixed pattern, the temporal noise and the quantisation in it.
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
  struct Ambient {
    double lux;  ///< Of the sky on level ground; a wall gets six tenths of it.
    double z_m;
    double valid;
  };
  struct Paint {
    double reflectance_830nm;
    double z_m;
    double valid;
  };
  std::vector<Distance> by_distance;
  std::vector<Incidence> by_incidence;
  std::vector<Ambient> by_ambient;
  std::vector<Paint> by_paint;
};

DepthCurves MeasureDepthCurves(const StructuredLightOptions& options, const RandomStream& stream);

/// Published curves. Khoshelham & Elberink 2012: 1.425e-3 z² [m].
double KhoshelhamSigma(double z_m);
/// Nguyen, Izadi & Lovell 2012: 0.0012 + 0.0019 (z - 0.4)² up to 60°, and beyond
/// 0.0001/√z θ²/(π/2 - θ)² more [m].
double NguyenSigma(double z_m, double angle_rad);

/// The models' curves side by side, with the published ones.
std::string DepthCurvesMarkdown(const DepthCurves& parametric, const DepthCurves& speckle);
cv::Mat3b DepthCurvesPicture(const DepthCurves& parametric, const DepthCurves& speckle);

}  // namespace fenestra
