#pragma once

#include <opencv2/core.hpp>

#include "core/random/random_stream.h"

namespace fenestra {

/// A linear image sensor after EMVA 1288 release 4.0. A pixel that collects μ_p photo-electrons on
/// average while it is exposed for t gives
///
///     N ~ Poisson(μ_p (1 + PRNU n₁) + μ_I t) + σ_d n₂ + DSNU n₃ + σ_row n₄          [e]
///     y = floor(y_0 + g K N + 1/2),  clipped to the ADC's range,
///
/// shifted right to the output's bits. n₁ and n₃ are fixed for each pixel of one camera, n₂ is new
/// in each pixel and n₄ in each row of each image; all are standard normal. y_0: black level;
/// g: analogue gain; K = (largest ADC value - y_0)/saturation_e. Dark current
/// μ_I(T) = μ_I(25 °C) 2^((T - 25 °C)/T_d).
///
/// Figures of the Aptina/onsemi MT9V032 where it or its siblings MT9V022/023/034 publish any; the
/// rest, marked "assumed", are usual for sensors of its kind and time.
struct ImageSensorOptions {
  /// Full scale at gain 1: 1.0 V ADC range at 62 µV per electron, which follows from 4.8 V/(lx s)
  /// at 550 nm (MT9V022/023/034 data sheets) and the quantum efficiency there.
  double saturation_e = 16000.0;
  double read_noise_e = 25.0;            ///< σ_d: 55–60 dB dynamic range give 16–29 e.
  double dark_current_e_s = 300.0;       ///< Dark current at 25 °C; assumed.
  double dark_current_doubling_k = 8.0;  ///< T_d; assumed, as silicon has it.
  double temperature_c = 40.0;           ///< Sensor in a closed housing; assumed.
  double dsnu_e = 20.0;                  ///< Assumed: 10–30 e.
  double prnu = 0.015;                   ///< Assumed: 1–2 %.
  double row_noise_e = 3.0;              ///< Left by the sensor's row-noise correction; assumed.
  int adc_bits = 10;                     ///< MT9V032.
  int output_bits = 8;                   ///< As the camera is operated; at most adc_bits.
  double black_level_dn = 32.0;  ///< Black level of the ADC; high enough for dark noise at gain 4.
  bool noise = true;             ///< Noise that differs from image to image.
  bool fixed_pattern = true;     ///< DSNU and PRNU.
};

/// Throws InputError with all faults; `who` names the camera in them.
void Validate(const ImageSensorOptions& options, const char* who);

/// Exposure of one image.
struct ExposureSetting {
  double exposure_s = 0.0;
  double gain = 1.0;  ///< Analogue, before the ADC.
};

/// Control of the exposure: fixed, or by the image's mean with a longer time first, then gain.
struct ExposureOptions {
  bool automatic = true;
  double set_point = 0.35;        ///< Mean signal above black, as a fraction of full scale.
  double exposure_s = 2e-3;       ///< Used when not automatic.
  double gain = 1.0;              ///< Used when not automatic.
  double shortest_s = 80e-6;      ///< uEye UI-122x, IDS manual.
  double longest_s = 1.0 / 60.0;  ///< One image at 60 Hz.
  double largest_gain = 4.0;      ///< MT9V032: 1–4.
};

/// The exposure for an image with the given mean of photo-electrons per pixel and second:
/// set_point · saturation = rate · t · g, within the limits. Darkness gives the longest.
ExposureSetting ChooseExposure(const ExposureOptions& exposure, const ImageSensorOptions& sensor,
                               double mean_electrons_per_s);

/// One camera's sensor with its fixed pattern. Const calls are thread-safe.
class ImageSensor {
 public:
  /// `camera`: the stream of this camera's fixed pattern.
  ImageSensor(const ImageSensorOptions& options, cv::Size size, const RandomStream& camera);

  const ImageSensorOptions& options() const { return options_; }
  cv::Size size() const { return size_; }
  /// g K in the output [DN/e].
  double DnPerElectron(double gain) const;
  /// Mean of the signal without light and dark current [output DN].
  double BlackLevelDn() const;
  /// Electrons per pixel of dark current in an exposure.
  double DarkElectrons(double exposure_s) const;
  /// Largest output value.
  int FullScaleDn() const { return (1 << options_.output_bits) - 1; }

  /// One image [output DN]. electrons_per_s: mean photo-electrons per pixel and second, of the
  /// sensor's size. `noise`: the stream of this image's noise.
  ///
  /// The sum of the Poisson and the normal law is drawn from one normal variate z by its
  /// Cornish–Fisher expansion: exact in mean and variance, and in skewness to second order. Close
  /// while the total variance is above 4 e²: cameras with less noise than σ_d = 2 e show a
  /// difference in their darkest pixels.
  cv::Mat1w Expose(const cv::Mat1f& electrons_per_s, const ExposureSetting& exposure,
                   const RandomStream& noise) const;

 private:
  ImageSensorOptions options_;
  cv::Size size_;
  cv::Mat1f dsnu_e_;       ///< Empty without fixed pattern.
  cv::Mat1f sensitivity_;  ///< 1 + PRNU n; empty without fixed pattern.
};

}  // namespace fenestra
