#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/random_stream.h"
#include "renderers/ray_grid.h"

namespace fenestra {

/// Exposure time: fixed, or chosen so that the mean of the image meets a set point.
struct ExposureOptions {
  bool automatic = true;
  double set_point = 0.35;        ///< Mean signal as a fraction of full scale.
  double exposure_s = 2e-3;       ///< Used when not automatic.
  double shortest_s = 80e-6;      ///< uEye UI-122x, IDS manual.
  double longest_s = 1.0 / 60.0;  ///< One frame at 60 Hz.
};

/// A linear image sensor after EMVA 1288: mean electrons μ_e = R H with the luminous exposure H
/// [lx s], variance of the signal μ_e + σ_d², ADC gain K = full scale / saturation.
struct ImageSensorOptions {
  /// Electrons per lux-second in one pixel, daylight through a 650 nm cut filter.
  /// Source: MT9V032 data sheet responsivity 4.8 V/(lx s) and MT9V034 quantum efficiency, weighted
  /// with AM1.5G.
  double electrons_per_lux_s = 1.7e5;
  double saturation_e = 16000.0;  ///< MT9V032: 1.0 V ADC range at 62 µV per electron.
  double read_noise_e = 25.0;     ///< MT9V032: 55–60 dB dynamic range give 16–29 e.
  bool noise = true;              ///< Shot and read noise; the quantisation to 8 bits remains.
};

/// Optics between a scene and its sensor.
struct LensOptions {
  double f_number = 2.8;
  double transmission = 0.9;
  /// Gaussian point spread of the lens [px], besides the pixel's own area.
  double blur_sigma_px = 0.45;
};

/// Image-plane illuminance per scene luminance on the axis: E/L = π τ / (4 N²) [lx/(cd/m²)].
double IlluminancePerLuminance(const LensOptions& lens);

/// Natural vignetting at the centre of each pixel: cos⁴ of the ray's angle to the optical axis.
cv::Mat1f NaturalVignetting(const RayGrid& rays);

/// The exposure time for an image of the given mean luminance [cd/m²] (vignetting included):
/// set_point · saturation = R · mean · E/L · t, within the shortest and the longest time.
double ChooseExposure(const ExposureOptions& exposure, const ImageSensorOptions& sensor,
                      const LensOptions& lens, double mean_luminance);

/// Convolves with the lens' point spread: a sampled Gaussian whose discrete variance is exactly
/// blur_sigma_px². Size and type as given; the border is replicated.
cv::Mat BlurByLens(const cv::Mat& radiance, const LensOptions& lens);

/// Taps of that Gaussian, of odd number, sum 1 and variance sigma_px². Domain: 0 ≤ sigma_px ≤ 20.
std::vector<float> GaussianTaps(double sigma_px);

/// Exposes one channel of luminance [cd/m²], already vignetted and blurred. Returns the signal as a
/// fraction of full scale, clipped to [0, 1] but not yet quantised: mean R L (E/L) t / saturation,
/// variance (μ_e + σ_d²) / saturation² where noise is on (the Poisson law by its normal limit; at
/// few electrons the read noise hides the difference).
cv::Mat1f Expose(const cv::Mat1f& luminance, const ImageSensorOptions& sensor,
                 const LensOptions& lens, double exposure_s, const RandomStream& noise);

}  // namespace fenestra
