#include "experiments/cramer_rao/pixel_noise.h"

#include <algorithm>
#include <cmath>

#include "core/io/srgb.h"

namespace fenestra {
namespace {

// Electrons per step of an 8-bit sRGB value, at x of full scale.
double EncodedStep_e(double x, double full_scale_e) {
  return full_scale_e / (255.0 * SrgbSlope(x));
}

}  // namespace

PixelNoise PixelNoise::Linear(const ImageSensorOptions& o, const ExposureSetting& exposure) {
  const ImageSensor sensor(o, {1, 1}, RandomStream(0));
  PixelNoise noise;
  noise.step_e_ = 1.0 / sensor.DnPerElectron(exposure.gain);
  noise.dark_e_ = sensor.DarkElectrons(exposure.exposure_s);
  noise.shoulder_e_ = o.linear_range * o.saturation_e / exposure.gain;
  if (o.noise) noise.constant_e2_ += o.read_noise_e * o.read_noise_e + noise.dark_e_;
  if (o.fixed_pattern) noise.constant_e2_ += o.dsnu_e * o.dsnu_e;
  noise.shot_ = o.noise ? 1.0 : 0.0;
  noise.prnu_ = o.fixed_pattern ? o.prnu : 0.0;
  noise.full_scale_e_ = sensor.FullScaleElectrons(exposure.gain) - noise.dark_e_;
  return noise;
}

PixelNoise PixelNoise::Encoded(const ImageSensorOptions& options, const ExposureSetting& exposure) {
  PixelNoise noise = Linear(options, exposure);
  noise.encoded_ = true;
  return noise;
}

double PixelNoise::Variance(double mean_e) const {
  // Beyond the shoulder the response's slope is √(shoulder/electrons).
  const double wider = std::max(1.0, (mean_e + dark_e_) / shoulder_e_);
  double variance = constant_e2_ + shot_ * mean_e + prnu_ * prnu_ * mean_e * mean_e +
                    step_e_ * step_e_ * wider / 12.0;
  if (encoded_) {
    const double step_e =
        EncodedStep_e(std::clamp(mean_e / full_scale_e_, 0.0, 1.0), full_scale_e_);
    variance += step_e * step_e / 12.0;
  }
  return variance;
}

double PixelNoise::VarianceSlope(double mean_e) const {
  return shot_ + 2.0 * prnu_ * prnu_ * mean_e;
}

bool PixelNoise::IsSaturated(double mean_e) const {
  return mean_e + 3.0 * std::sqrt(Variance(mean_e)) >= full_scale_e_;
}

}  // namespace fenestra
