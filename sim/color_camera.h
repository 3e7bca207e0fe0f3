#pragma once

#include <array>

#include "core/camera_model.h"
#include "core/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/image_sensor.h"
#include "sim/lens.h"

namespace fenestra {

/// The colour camera of a structured-light sensor, in frame K. Figures: Microsoft Kinect SDK 1.8.
struct ColorCameraOptions {
  int width_px = 640;
  int height_px = 480;
  double focal_px = 531.15;  ///< At 640 x 480.

  LensOptions lens{.f_number = 2.0,
                   .transmission = 0.9,
                   .blur_sigma_px = 0.5,
                   .corner_blur_sigma_px = 0.7,
                   .corner_illumination = 0.9};
  /// Blur in red and blue as multiples of that in green; 1: a lens without colour errors.
  double red_blur = 1.0;
  double blue_blur = 1.0;
  double electrons_per_lux_s = 2.0e4;  ///< In one channel; assumed.
  /// Small pixels: 2.8 µm against the 6 µm of the machine-vision camera.
  ImageSensorOptions sensor{.saturation_e = 6000.0,
                            .read_noise_e = 6.0,
                            .dark_current_e_s = 50.0,
                            .dsnu_e = 3.0,
                            .prnu = 0.01,
                            .row_noise_e = 0.0,
                            .adc_bits = 10,
                            .output_bits = 10};
  /// Mean of the sRGB-encoded image that automatic exposure aims for, of 255.
  double mean_dn = 118.0;
  bool auto_exposure = true;
  double exposure_s = 8e-3;  ///< Used when not automatic.
};

CameraModel DesignOf(const ColorCameraOptions& options);

/// Throws InputError with all faults.
void Validate(const ColorCameraOptions& options);

/// From radiance in three channels over lens, exposure and noise to sRGB.
class ColorCamera {
 public:
  /// edge_samples_per_pixel: see RenderOptions.
  ColorCamera(const ColorCameraOptions& options, int edge_samples_per_pixel);

  /// B, G, R.
  cv::Mat3b Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WK,
                    const RandomStream& shot) const;

 private:
  /// Fixed, or such that the encoded image's mean is mean_dn; B, G, R in electrons per second.
  double Exposure(const std::array<cv::Mat1f, 3>& electrons_per_s) const;
  cv::Mat1b Develop(const cv::Mat1f& electrons_per_s, double exposure_s,
                    const RandomStream& frame) const;

  ColorCameraOptions options_;
  int edge_samples_per_pixel_;
  RayGrid rays_;
  cv::Mat1f illumination_;
  ImageSensor sensor_;
};

}  // namespace fenestra
