#pragma once

#include <memory>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/camera/image_sensor.h"
#include "sim/camera/lens.h"
#include "sim/camera/spectral_response.h"
#include "sim/motion/rig_pose.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// Deviations of a rig as built from its design: standard deviations of independent normal laws for
/// each camera. Assumed from the promises of workshops and lens makers' catalogues.
struct RigTolerances {
  double focal_length = 0.01;       ///< Relative, the same for both axes.
  double principal_point_px = 5.0;  ///< Each axis.
  double distortion = 0.05;         ///< Relative, for each coefficient.
  double rotation_rad = 3e-3;       ///< About each axis.
  double translation_m = 5e-4;      ///< Along each axis.
  double gain = 0.02;               ///< Relative, of grey values per electron.
};

/// A pair of IDS uEye UI-1226LE-M-G (MT9V032, 752 x 480, 6 µm) on a 35 cm bar, as designed.
struct StereoRigOptions {
  int width_px = 752;
  int height_px = 480;
  double pixel_pitch_m = 6e-6;
  double focal_length_m = 4e-3;
  double baseline_m = 0.35;
  /// Radial distortion of a short S-mount lens; the paper names no lens, and published values for
  /// this sensor family reach from -0.1 to -0.35.
  BrownConrady distortion{.k1 = -0.10, .k2 = 0.01, .p1 = 1e-4, .p2 = -1e-4, .k3 = 0.0};
  LensOptions lens;
  SpectralOptions spectrum;
  ImageSensorOptions sensor;
  ExposureOptions exposure;
  /// Whether each camera chooses its exposure by its own image, as cameras without a common
  /// controller do; otherwise both have that of the left one.
  bool own_exposure = true;
  bool as_designed = false;  ///< Whether the rig has no deviations; tolerances have no effect then.
  RigTolerances tolerances;
  RigMotion motion;
  /// Delay of the right camera's exposure after the left one's [s].
  double trigger_skew_s = 0.0;
  /// Samples of pixels that more than one edge crosses; see RenderOptions.
  int edge_samples_per_pixel = 256;
};

/// Throws InputError with all faults.
void Validate(const StereoRigOptions& options);

/// The rig as designed, before any tolerance.
StereoCalibration DesignOf(const StereoRigOptions& options);

/// How one camera of a pair took its image.
struct ExposedView {
  ExposureSetting exposure;
  ImageSensorOptions sensor;  ///< Of this camera, as built.
  /// Mean photo-electrons of each pixel in the exposure, before fixed pattern and noise.
  cv::Mat1f electrons;
};

/// A pair of images with their exposures and light.
struct StereoShot {
  StereoObservation observation;
  ExposedView left;
  ExposedView right;
};

/// A rig as it was built: true cameras and poses, and each camera's fixed pattern.
/// Frame B: origin midway between the cameras as designed, axes of the left camera as designed.
///
/// Both shutters are global. Poses, and with them the ground truth, are those at the middle of the
/// left camera's exposure. The trigger begins both exposures, so that the middle of a longer one is
/// later. Automatic exposure goes by the mean of a coarse picture without motion, as cameras go by
/// the image before.
class StereoRig {
 public:
  /// Draws the rig that belongs to the stream, within its tolerances. Throws InputError.
  StereoRig(const StereoRigOptions& options, const RandomStream& rig);

  /// This rig after the right camera has been displaced.
  StereoRig Displaced(const Pose& X_RRnew) const;
  /// This rig standing still, with both cameras triggered at once.
  StereoRig Still() const;
  /// This rig with the noise and the fixed pattern of its sensors, if its options leave them out.
  StereoRig WithNoise() const;

  const StereoRigOptions& options() const { return options_; }
  /// True cameras. Detectors receive a StereoCalibration from CalibratedRig instead.
  const StereoCalibration& cameras() const { return cameras_; }
  const Pose& X_BL() const { return X_BL_; }
  /// Identifies the fixed patterns of this rig's cameras.
  uint64_t pattern_key() const { return pattern_key_; }
  Pose X_BR() const { return X_BL_ * cameras_.X_RL.inverse(); }

  StereoObservation Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                            const RandomStream& shot) const;
  /// An observation with its exposure and light.
  StereoShot Shoot(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                   const RandomStream& shot) const;
  /// The images that optics and sensors make of luminance in the image plane, given by quarters of
  /// pixels [cd/m²].
  StereoObservation Develop(const QuarterImages& left, const QuarterImages& right,
                            const RandomStream& shot) const;
  GroundTruth Truth(const Scene& scene, const Pose& X_WB) const;
  /// Per-pixel truth of the left camera.
  TruthImages PixelTruth(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB) const;

 private:
  // The parts of a camera that do not change when a rig is displaced.
  struct Camera {
    Camera(const CameraModel& model, const StereoRigOptions& options, const RandomStream& own);
    void SetSensor(const ImageSensorOptions& options);
    RandomStream stream;
    RayGrid rays;
    cv::Mat1f illumination;
    RayGrid metering_rays;  ///< Of pixels that are several times as large.
    cv::Mat1f metering_illumination;
    double gain;  ///< Grey values per electron, as a multiple of the design's.
    ImageSensor sensor;
  };

  /// Luminance on the sensor, averaged over an exposure around t.
  QuarterImages Light(const Camera& camera, const Pose& X_BC, const RayCaster& caster,
                      const Lighting& lighting, const Pose& X_WB, double t_s, double exposure_s,
                      const RandomStream& sampling) const;
  /// Photo-electrons per pixel and second for this luminance.
  cv::Mat1f ElectronsPerSecond(const Camera& camera, const QuarterImages& light) const;
  /// Photo-electrons per pixel and second on average, where the rig stands.
  double MeanElectronsPerSecond(const Camera& camera, const Pose& X_WC, const RayCaster& caster,
                                const Lighting& lighting, const RandomStream& sampling) const;
  /// The exposure for an image with this mean of photo-electrons per pixel and second.
  ExposureSetting ExposureFor(const Camera& camera, double mean_electrons_per_s) const;
  double ElectronsPerLuminance() const;
  /// A camera's view and its image of photo-electrons per pixel and second.
  static ExposedView Exposed(const Camera& camera, const cv::Mat1f& electrons_per_s,
                             const ExposureSetting& exposure);
  static cv::Mat1b ImageOf(const Camera& camera, const cv::Mat1f& electrons_per_s,
                           const ExposureSetting& exposure, const RandomStream& noise);

  StereoRigOptions options_;
  StereoCalibration cameras_;
  Pose X_BL_;
  uint64_t pattern_key_;
  std::shared_ptr<const Camera> left_;
  std::shared_ptr<const Camera> right_;
};

}  // namespace fenestra
