#pragma once

#include "core/calibration.h"
#include "core/observation.h"
#include "core/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/ground_truth.h"
#include "sim/image_sensor.h"
#include "sim/truth_images.h"

namespace fenestra {

/// A pair of IDS uEye UI-1226LE-M-G (MT9V032, 752 x 480, 6 µm) on a 35 cm bar.
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
  ImageSensorOptions sensor;
  ExposureOptions exposure;
  /// How far a rig as built departs from what detectors are told: standard deviations of the right
  /// camera's rotation about and translation along each axis. The size of a good calibration.
  double rotation_tolerance_rad = 1e-4;
  double translation_tolerance_m = 1e-4;
  /// Where more than one edge crosses a pixel; see RenderOptions.
  int edge_samples_per_pixel = 256;
};

/// Throws InputError with all faults.
void Validate(const StereoRigOptions& options);

/// The stereo rig. Frame B: origin midway between the nominal cameras, axes of the nominal left
/// camera.
class StereoRig {
 public:
  explicit StereoRig(const StereoRigOptions& options);

  const StereoRigOptions& options() const { return options_; }
  /// What detectors are told.
  const StereoCalibration& nominal() const { return nominal_; }

  /// One rig as it was built.
  struct TrueState {
    Pose X_BL;
    Pose X_BR;
  };
  TrueState Draw(const RandomStream& rig) const;
  /// A rig that is as detectors are told.
  TrueState Nominal() const;

  StereoObservation Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                            const TrueState& state, const RandomStream& shot) const;
  GroundTruth Truth(const Scene& scene, const Pose& X_WB, const TrueState& state) const;
  TruthImages LeftTruth(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                        const TrueState& state) const;

 private:
  StereoRigOptions options_;
  StereoCalibration nominal_;
  RayGrid rays_;  ///< Both cameras have the same nominal intrinsics.
  cv::Mat1f vignetting_;
};

}  // namespace fenestra
