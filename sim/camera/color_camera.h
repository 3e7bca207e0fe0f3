#pragma once

#include <array>

#include "core/geometry/camera_model.h"
#include "core/random/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/camera/image_sensor.h"
#include "sim/camera/lens.h"
#include "sim/camera/point_spread.h"
#include "sim/motion/rolling_shutter.h"

namespace fenestra {

/// The colour camera of a structured-light sensor, in frame K. Figures: Microsoft Kinect SDK 1.8.
struct ColorCameraOptions {
  int width_px = 640;
  int height_px = 480;
  double focal_px = 531.15;  ///< At 640 x 480.
  /// Of the Kinect that took the TUM RGB-D benchmark's freiburg2 sequences; that of freiburg1 had
  /// 0.262, -0.953, -0.0054, 0.0026 and 1.163.
  BrownConrady distortion{
      .k1 = 0.231222, .k2 = -0.784899, .p1 = -0.003257, .p2 = -0.000105, .k3 = 0.917205};

  LensOptions lens{.f_number = 2.0,
                   .transmission = 0.9,
                   .blur_sigma_px = 0.5,
                   .corner_blur_sigma_px = 0.7,
                   .corner_illumination = 0.9};
  /// Blur in red and blue as multiples of the blur in green; 1: a lens without colour errors.
  double red_blur = 1.0;
  double blue_blur = 1.0;
  double electrons_per_lux_s = 2.0e4;  ///< Response of one channel; assumed.
  /// Small pixels: 2.8 µm against the 6 µm of the machine-vision camera.
  ImageSensorOptions sensor{.saturation_e = 6000.0,
                            .linear_range = 1.0,
                            .read_noise_e = 6.0,
                            .dark_current_e_s = 50.0,
                            .dsnu_e = 3.0,
                            .prnu = 0.01,
                            .row_noise_e = 0.0,
                            .adc_bits = 10,
                            .output_bits = 10,
                            .black_level_dn = 32.0};
  /// Mean of the sRGB-encoded image that automatic exposure aims for, of 255.
  double mean_dn = 118.0;
  bool auto_exposure = true;
  double exposure_s = 8e-3;  ///< Used when not automatic.
  /// Rolling shutter; assumed to equal the infra-red camera's: 960 of 1049 rows' times in 1/30 s.
  double readout_s = 30.5e-3;
  /// Rays through each pixel without an edge, and lines of the search for edges. Both are coarser
  /// than for the stereo rig, with errors of less than a third of the noise.
  int samples_per_pixel = 1;
  EdgeLines edge_lines = EdgeLines::kFour;
};

CameraModel DesignOf(const ColorCameraOptions& options);

/// Throws InputError with all faults.
void Validate(const ColorCameraOptions& options);

/// Turns radiance in three channels into an sRGB image, by lens, exposure and noise.
class ColorCamera {
 public:
  /// `camera`: as it truly is, of the options' size. X_BK: its pose on a rig with this motion;
  /// edge_samples_per_pixel: see RenderOptions; `pixels`: the stream of their fixed pattern.
  ColorCamera(const ColorCameraOptions& options, const CameraModel& camera, const Pose& X_BK,
              const RigMotion& motion, int edge_samples_per_pixel, const RandomStream& pixels);

  /// An image in B, G, R. X_WB: pose of the rig in the middle of the image's exposure. Rows are
  /// exposed one after the other, and motion during the exposure blurs the image.
  cv::Mat3b Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                    const RandomStream& shot) const;

 private:
  /// The exposure time: fixed, or such that the encoded image's mean is mean_dn. The light is B, G,
  /// R in electrons per second.
  double Exposure(const std::array<cv::Mat1f, 3>& electrons_per_s) const;
  cv::Mat1b Develop(const cv::Mat1f& electrons_per_s, double exposure_s,
                    const RandomStream& noise) const;

  /// Luminance on the sensor, averaged over each row's exposure.
  QuarterImages LightDuring(double exposure_s, const RayCaster& caster, const Lighting& lighting,
                            const Pose& X_WB, const RandomStream& sampling) const;
  /// Photo-electrons in B, G and R for this luminance.
  std::array<cv::Mat1f, 3> ElectronsPerSecond(const QuarterImages& luminance) const;

  ColorCameraOptions options_;
  Pose X_BK_;
  RollingShutter shutter_;
  int edge_samples_per_pixel_;
  RayGrid rays_;
  cv::Mat1f illumination_;
  ImageSensor sensor_;
};

}  // namespace fenestra
