#pragma once

#include <opencv2/core.hpp>

#include "core/random/random_stream.h"

namespace fenestra {

/// An image sensor after EMVA 1288 release 4.0, linear up to a shoulder. A pixel that collects μ_p
/// photo-electrons on average while it is exposed for t gives
///
///     N ~ Poisson(μ_p (1 + PRNU n₁) + μ_I t) + σ_d n₂ + DSNU n₃ + σ_row n₄          [e]
///     y = floor(y_0 + R(g K N) + 1/2),  clipped to the ADC's range,
///     R(x) = x up to s, 2 √(s x) - s beyond,  s = linear_range (largest ADC value - y_0),
///
/// shifted right to the output's bits. n₁ and n₃ are fixed for each pixel of one camera, n₂ is new
/// in each pixel and n₄ in each row of each image; all are standard normal. y_0: black level;
/// g: analogue gain; K = (largest ADC value - y_0)/saturation_e. Dark current
/// μ_I(T) = μ_I(25 °C) 2^((T - 25 °C)/T_d). On the shoulder R, shot noise keeps the variance that
/// it has at s. Charge does not spill into neighbours (blooming): no figure is published for it.
///
/// Figures of the Aptina/onsemi MT9V032 where it or its siblings MT9V022/023/034 publish any, and
/// of recorded 8-bit images of the MT9V034; the rest, marked "assumed", are usual for sensors of
/// its kind and time. In the recordings the variance is 0.5 DN² at 12 DN, grows by 0.03 DN²/DN up
/// to 170 DN and is flat beyond; black is at about 10 DN. That is twice the K of the data sheets at
/// gain 1, and taken for a gain of 2, which the recordings do not state: at gain 1 their darkness
/// would have 53 dB of range, less than the data sheets' least, and at gain 2 it has 59 dB.
struct ImageSensorOptions {
  /// Electrons that would fill the range at gain 1 without a shoulder: 1.0 V ADC range at 62 µV per
  /// electron, which follows from 4.8 V/(lx s) at 550 nm (MT9V022/023/034 data sheets) and the
  /// quantum efficiency there.
  double saturation_e = 16000.0;
  double linear_range = 0.65;  ///< Up to 170 of 255 DN in the recordings; 1: no shoulder.
  /// σ_d: 55–60 dB dynamic range give 16–29 e, the recordings' dark variance at gain 2 gives 20.
  double read_noise_e = 20.0;
  double dark_current_e_s = 300.0;       ///< Dark current at 25 °C; assumed.
  double dark_current_doubling_k = 8.0;  ///< T_d; assumed, as silicon has it.
  double temperature_c = 40.0;           ///< Sensor in a closed housing; assumed.
  double dsnu_e = 20.0;                  ///< Assumed: 10–30 e.
  double prnu = 0.015;                   ///< Assumed: 1–2 %.
  double row_noise_e = 3.0;              ///< Left by the sensor's row-noise correction; assumed.
  int adc_bits = 10;                     ///< MT9V032.
  int output_bits = 8;                   ///< As the camera is operated; at most adc_bits.
  double black_level_dn = 40.0;  ///< Black level of the ADC: 10 of 255 DN in the recordings.
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
  /// g K in the output [DN/e], below the shoulder.
  double DnPerElectron(double gain) const;
  /// Electrons that fill the range, shoulder and all.
  double FullScaleElectrons(double gain) const;
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
