#pragma once

#include <array>
#include <memory>
#include <variant>

#include "core/calibration.h"
#include "core/observation.h"
#include "core/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/depth_frame.h"
#include "sim/ground_truth.h"
#include "sim/image_sensor.h"
#include "sim/infrared_image.h"
#include "sim/lens.h"
#include "sim/parametric_depth.h"
#include "sim/speckle_depth.h"
#include "sim/truth_images.h"

namespace fenestra {

/// How depth comes about.
enum class DepthModel {
  kParametric,  ///< From what windows would hold, by formulae; see ParametricDepth. Fast.
  kSpeckle,     ///< An infra-red image of the dots, searched for the pattern; see SpeckleDepth.
};

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

  DepthModel depth_model = DepthModel::kParametric;
  InfraredOptions infrared;
  ParametricDepthOptions parametric;
  SpeckleMatchingOptions matching;  ///< Of both models.
  /// Width of the infra-red image in which kSpeckle matches: a multiple of the depth image's. Depth
  /// pixels are those of every so many columns and rows.
  int infrared_width_px = 640;
  /// Quantum of the disparity, in pixels of a 640-wide image: 1/8 px (ROS
  /// kinect_calibration/technical) in OpenNI's drivers; 1/16 px, by the levels of its depth table,
  /// in the Microsoft SDK's. 0: none.
  double disparity_step_px = 0.125;
  /// Depth images at 30 Hz that are averaged, each with its own noise: the mean of the returns of
  /// pixels with a return in at least half of them.
  int averaged_frames = 1;

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

/// A structured-light sensor. Frame B is the depth camera D.
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
  DepthFrame ObserveDepth(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                          const RandomStream& shot) const;

 private:
  DepthFrame OneDepthFrame(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                           const RandomStream& shot, const RandomStream& frame) const;
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
  std::variant<std::shared_ptr<const ParametricDepth>, std::shared_ptr<const SpeckleDepth>>
      depth_model_;
  cv::Mat1f color_illumination_;
  ImageSensor color_sensor_;
};

}  // namespace fenestra
