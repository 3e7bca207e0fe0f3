#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/camera/color_camera.h"
#include "sim/structured_light/explained_depth.h"
#include "sim/structured_light/infrared_response.h"
#include "sim/structured_light/matched_depth.h"
#include "sim/structured_light/parametric_depth.h"
#include "sim/structured_light/sensor_unit.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// The model of the depth measurement.
enum class DepthModel {
  kParametric,  ///< From what windows would hold, by formulae; see ParametricDepth. Fast.
  kMatched,     ///< An infra-red image of the dots, searched for the pattern; see MatchedDepth.
};

/// A Kinect-like sensor: colour camera, infra-red depth camera, and a projector of dots.
/// Figures: Microsoft Kinect SDK 1.8 constants, ROS kinect_calibration/technical, Khoshelham &
/// Elberink 2012, Landau 2015.
struct StructuredLightOptions {
  int depth_width_px = 320;
  int depth_height_px = 240;
  double depth_focal_px = 285.63;       ///< At 320 x 240; MS SDK 1.8.
  double color_offset_m = 0.025;        ///< Colour camera right (+x) of the depth camera.
  double projector_baseline_m = 0.075;  ///< Projector right (+x) of the depth camera.

  /// Motion of frame B while images are taken. Truth is that of X_WB: where the rig is when the
  /// middle rows of depth and colour image are exposed.
  RigMotion motion;
  /// Rolling shutter of the infra-red camera, an MT9M001: from the first row of the image to the
  /// last. Assumed: 1049 rows' times, blanking included, in 1/30 s, and 960 of them in the image.
  /// The exposure is taken to be short.
  double infrared_readout_s = 30.5e-3;

  DepthDriver driver = DepthDriver::kMicrosoft;
  bool near_mode = false;  ///< 0.4–3.0 m instead of 0.8–4.0 m; Microsoft's driver only.
  bool quantised = true;   ///< Whether disparities come in the driver's steps.

  DepthModel depth_model = DepthModel::kParametric;
  InfraredOptions infrared;
  ParametricDepthOptions parametric;
  PatternMatchingOptions matching;  ///< Options of both models.
  /// Width of the infra-red image in which kMatched matches: a multiple of the depth image's. Depth
  /// pixels are those of every so many columns and rows.
  int infrared_width_px = 640;
  /// Depth images at 30 Hz that are averaged, the last of them in time with the colour image, each
  /// with its own noise: the mean of the returns of pixels with a return in at least half of them.
  int averaged_frames = 1;
  /// Whether the depth image is delivered as the colour camera would see it (DepthRegistrar), in as
  /// many pixels as before.
  bool registered_depth = false;

  ColorCameraOptions color;
  /// From the middle of the depth image's exposure to that of the colour image's: the streams of
  /// 30 Hz are not synchronised. Assumed; up to half a period.
  double color_delay_s = 8e-3;
  int edge_samples_per_pixel = 64;
};

/// Throws InputError with all faults.
void Validate(const StructuredLightOptions& options);

/// The disparities that a sensor delivers.
DisparityRange RangeOf(const StructuredLightOptions& options);

/// The cameras as designed, the depth camera being the infra-red camera.
RgbdCalibration DesignOf(const StructuredLightOptions& options);

/// A structured-light sensor. Frame B is the infra-red camera, whose pixels the depth image has
/// unless it is registered.
class StructuredLightSensor {
 public:
  /// As designed.
  explicit StructuredLightSensor(const StructuredLightOptions& options);

  /// A sensor of this design as built. What is known of it, nominal(), stays the same; the colour
  /// camera's pixels differ, too.
  StructuredLightSensor Unit(const UnitDeviations& deviations, const RandomStream& unit) const;

  const StructuredLightOptions& options() const { return options_; }
  /// What is known of the sensor: the design. If depth is registered, the depth camera is the
  /// colour camera, with the depth image's pixels.
  const RgbdCalibration& nominal() const { return nominal_; }
  /// The same as it truly is. The driver registers depth by what is known: its pixels are not quite
  /// where this says.
  const RgbdCalibration& cameras() const { return cameras_; }
  const SensorUnit& unit() const { return unit_; }
  const InfraredResponse& infrared_response() const;

  /// Poses of the camera of the depth image's pixels, and of the colour camera.
  Pose X_WD(const Pose& X_WB) const;
  Pose X_WK(const Pose& X_WB) const;

  RgbdObservation Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                          const RandomStream& shot) const;
  GroundTruth Truth(const Scene& scene, const Pose& X_WB) const;
  /// Per-pixel truth of the depth camera.
  TruthImages PixelTruth(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB) const;

  /// The depth image with the reasons of its holes; Observe's depth is the same.
  ExplainedDepth ObserveDepth(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                              const RandomStream& shot) const;

 private:
  /// The mean of several images in the infra-red camera's view.
  ExplainedDepth AverageDepth(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                              const RandomStream& shot) const;
  ExplainedDepth OneImage(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                          const RandomStream& shot, const RandomStream& image_noise) const;

  StructuredLightOptions options_;
  RgbdCalibration nominal_;
  SensorUnit unit_;
  RgbdCalibration cameras_;
  std::variant<std::shared_ptr<const ParametricDepth>, std::shared_ptr<const MatchedDepth>>
      depth_model_;
  ColorCamera color_;
  std::optional<DepthRegistrar> registrar_;
};

}  // namespace fenestra
