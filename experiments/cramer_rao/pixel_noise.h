#pragma once

#include "sim/camera/image_sensor.h"

namespace fenestra {

/// How much the value of a pixel that collects μ photo-electrons on average departs from that, in
/// electrons: the sensor of sim/camera/image_sensor as a detector meets it, who does not know the
/// fixed pattern:
///
///     V(μ) = σ_d² + μ_I t + DSNU² + μ + (PRNU μ)² + q(μ)²/12   [e²],
///
/// q: a step of the picture's values, which is wider where the sensor's response has a shoulder.
/// Row noise is left out: all pixels of a row tell it. Steps count as noise of their own, which
/// holds while the rest is above a third of a step.
class PixelNoise {
 public:
  /// Values as the sensor gives them.
  static PixelNoise Linear(const ImageSensorOptions& options, const ExposureSetting& exposure);
  /// Values without black level, sRGB-encoded in 8 bits.
  static PixelNoise Encoded(const ImageSensorOptions& options, const ExposureSetting& exposure);

  /// V(μ) [e²], with the quantisation step at μ: in sRGB values steps grow with the light.
  /// Domain: μ ≥ 0.
  double Variance(double mean_e) const;
  /// dV/dμ, of shot noise and fixed pattern.
  double VarianceSlope(double mean_e) const;
  /// Whether the pixel is so near to saturation (3 σ) that its value tells little.
  bool IsSaturated(double mean_e) const;
  /// Photo-electrons that fill a pixel.
  double full_scale_e() const { return full_scale_e_; }

 private:
  double constant_e2_ = 0.0;
  double step_e_ = 0.0;  ///< Where the response is linear.
  double dark_e_ = 0.0;
  double shoulder_e_ = 0.0;  ///< Up to where it is, dark electrons included.
  double shot_ = 1.0;
  double prnu_ = 0.0;
  double full_scale_e_ = 0.0;
  bool encoded_ = false;
};

}  // namespace fenestra
