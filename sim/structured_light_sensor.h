#pragma once

#include <array>
#include <numbers>

#include "core/calibration.h"
#include "core/observation.h"
#include "core/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/ground_truth.h"
#include "sim/image_sensor.h"
#include "sim/lens.h"
#include "sim/truth_images.h"

namespace fenestra {

/// A Kinect-like sensor: colour camera, infra-red depth camera, and a projector of dots.
/// Figures: Microsoft Kinect SDK 1.8 constants, ROS kinect_calibration/technical, Khoshelham &
/// Elberink 2012, Landau 2015.
struct StructuredLightOptions {
  int depth_width_px = 320;
  int depth_height_px = 240;
  double depth_focal_px = 285.63;  ///< At 320 x 240; MS SDK 1.8.
  int color_width_px = 640;
  int color_height_px = 480;
  double color_focal_px = 531.15;       ///< At 640 x 480; MS SDK 1.8.
  double color_offset_m = 0.025;        ///< Colour camera right (+x) of the depth camera.
  double projector_baseline_m = 0.075;  ///< Projector right (+x) of the depth camera.

  bool near_mode = false;  ///< 0.4–3.0 m instead of 0.8–4.0 m (MS SDK).

  /// Disparity step and noise, in pixels of the 640-wide image in which the sensor matches.
  double disparity_step_px = 0.125;  ///< 1/8 px (ROS kinect_calibration/technical).
  /// Before quantisation. Khoshelham's σ_z = 1.425e-3 z² is 0.061 px at f b = 42.8 px m and
  /// includes the step's 0.125/√12 = 0.036 px: √(0.061² − 0.036²) = 0.049.
  double disparity_noise_px = 0.049;
  /// Side of the window that is matched (ROS kinect_calibration/technical: 9 x 9 or 9 x 7): pixels
  /// that share a window share its noise.
  int matching_window_px = 9;
  /// Lateral jitter of each depth pixel, in the same pixels (Barron & Handa, simkinect: 0.5).
  double lateral_noise_px = 0.5;

  /// Signal of a dot on a surface of reflectance 0.8 at 1 m [10-bit DN] (Landau 2015: 5.90e8/r²).
  double dot_signal_dn = 590.0;
  double dark_noise_dn = 10.4;    ///< Standard deviation of the infra-red image (Landau 2015).
  double shot_noise_dn = 0.5;     ///< Variance per DN of signal (Landau 2015: gamma noise).
  double saturation_dn = 1023.0;  ///< 10 bits.
  /// A 9 x 9 window holds 9 dots: its evidence is √9 times a dot's. Matched when it exceeds this.
  double matching_snr = 3.5;
  double grazing_limit_rad =
      75.0 * std::numbers::pi / 180.0;  ///< Between the 70° and 80° that users report.
  /// Peak irradiance of a dot at 1 m [W/m²]: 60 mW spread over the field of view, 11 % of it dots.
  double dot_irradiance = 0.574;
  /// Full width of the infra-red filter [nm]: how much ambient light competes with the dots.
  double filter_width_nm = 10.0;

  LensOptions color_lens{.f_number = 2.0,
                         .transmission = 0.9,
                         .blur_sigma_px = 0.5,
                         .corner_blur_sigma_px = 0.7,
                         .corner_illumination = 0.9};
  /// Blur in red and blue as multiples of that in green; 1: a lens without colour errors.
  double color_red_blur = 1.0;
  double color_blue_blur = 1.0;
  double color_electrons_per_lux_s = 2.0e4;  ///< In one channel; assumed.
  /// Small pixels: 2.8 µm against the 6 µm of the machine-vision camera.
  ImageSensorOptions color_sensor{.saturation_e = 6000.0,
                                  .read_noise_e = 6.0,
                                  .dark_current_e_s = 50.0,
                                  .dsnu_e = 3.0,
                                  .prnu = 0.01,
                                  .row_noise_e = 0.0,
                                  .adc_bits = 10,
                                  .output_bits = 10};
  /// Mean of the sRGB-encoded image that automatic exposure aims for, of 255.
  double color_mean_dn = 118.0;
  bool color_auto_exposure = true;
  double color_exposure_s = 8e-3;  ///< Used when not automatic.
  int edge_samples_per_pixel = 64;
};

/// Throws InputError with all faults.
void Validate(const StructuredLightOptions& options);

/// Why a depth pixel has no return; for truth only, detectors never see it.
enum class NoReturn : unsigned char {
  kNone = 0,  ///< There is a return.
  kNoSurface,
  kRange,
  kShadow,
  kGrazing,
  kDark,       ///< The dots do not stand out of the noise, of ambient light among others.
  kSaturated,  ///< Ambient light alone saturates the infra-red image.
};

/// The parametric structured-light sensor. Frame B is the depth camera D.
class StructuredLightSensor {
 public:
  explicit StructuredLightSensor(const StructuredLightOptions& options);

  const StructuredLightOptions& options() const { return options_; }
  const RgbdCalibration& nominal() const { return nominal_; }

  RgbdObservation Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                          const RandomStream& shot) const;
  GroundTruth Truth(const Scene& scene, const Pose& X_WB) const;
  /// Of the depth camera.
  TruthImages PixelTruth(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB) const;

  /// The depth image with its reasons; Observe's depth is the same.
  struct DepthFrame {
    DepthImage depth;
    cv::Mat1b no_return;  ///< NoReturn.
  };
  DepthFrame ObserveDepth(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                          const RandomStream& shot) const;

 private:
  cv::Mat3b ObserveColor(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                         const RandomStream& shot) const;
  /// Fixed, or such that the encoded image's mean is color_mean_dn; B, G, R in electrons per
  /// second.
  double ColorExposure(const std::array<cv::Mat1f, 3>& electrons_per_s) const;
  cv::Mat1b DevelopColor(const cv::Mat1f& electrons_per_s, double exposure_s,
                         const RandomStream& frame) const;

  StructuredLightOptions options_;
  RgbdCalibration nominal_;
  RayGrid depth_rays_;
  RayGrid color_rays_;
  cv::Mat1f color_illumination_;
  ImageSensor color_sensor_;
};

}  // namespace fenestra
