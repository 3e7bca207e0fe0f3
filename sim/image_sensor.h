#pragma once

#include <opencv2/core.hpp>

#include "core/random_stream.h"

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
  int bits = 8;
  bool noise = true;              ///< Shot and read noise; quantisation always remains.
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

/// Mean luminance over the image (CV_32F, any channels) to the exposure time.
double ChooseExposure(const ExposureOptions& exposure, const ImageSensorOptions& sensor,
                      const LensOptions& lens, double mean_luminance);

/// Convolves with the lens' point spread. Sizes and type as given.
cv::Mat BlurByLens(const cv::Mat& radiance, const LensOptions& lens);

/// Exposes one channel of luminance [cd/m²], already blurred: returns the mean-plus-noise signal as
/// a fraction of full scale, clipped to [0, 1] but not yet quantised.
cv::Mat1f Expose(const cv::Mat1f& luminance, const ImageSensorOptions& sensor,
                 const LensOptions& lens, double exposure_s, const RandomStream& noise);

}  // namespace fenestra
