#pragma once

#include <memory>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/camera/image_sensor.h"
#include "sim/camera/point_spread.h"
#include "sim/motion/rig_pose.h"
#include "sim/stereo/stereo_camera.h"
#include "sim/stereo/stereo_rig_options.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// How one camera of a pair took its image.
struct ExposedView {
  ExposureSetting exposure;
  ImageSensorOptions sensor;  ///< Of this camera, as built.
  PointSpread spread;
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

  /// The rig's motion while it takes this image.
  RigMotion MotionDuring(const RandomStream& shot) const;

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
  /// Luminance on the sensor of a camera in motion, averaged over an exposure around t. Nothing is
  /// nearer than nearest_m.
  QuarterImages Light(const StereoCamera& camera, const Pose& X_BC, const RayCaster& caster,
                      const Lighting& lighting, const Pose& X_WB, const RigMotion& motion,
                      double nearest_m, double t_s, double exposure_s,
                      const RandomStream& sampling) const;

  StereoRigOptions options_;
  Pose X_BL_;
  uint64_t pattern_key_;
  // Shared by copies of a rig, whose cameras stay the same when one is displaced.
  std::shared_ptr<const StereoCamera> left_;
  std::shared_ptr<const StereoCamera> right_;
  StereoCalibration cameras_;
};

}  // namespace fenestra
