#pragma once

#include "core/geometry/calibration.h"
#include "sim/camera/built_camera.h"
#include "sim/camera/image_sensor.h"
#include "sim/camera/lens.h"
#include "sim/camera/spectral_response.h"
#include "sim/motion/rig_pose.h"

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
  double sensor_tilt_rad = 3e-3;    ///< About each axis, against the lens' focal surface.
  /// Decentring of the lens' parts: place in the image where coma vanishes, each axis, in half
  /// diagonals.
  double coma_centre = 0.3;

  /// Of the camera model.
  CameraDeviations camera() const {
    return {.focal_length = focal_length,
            .principal_point_px = principal_point_px,
            .distortion = distortion};
  }
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
  /// Sagittal coma in the corners, S₁ of PointSpread [px]. Assumed: it alone makes the blur's
  /// variance grow towards the corners, S₁²/3 = σ₁² - σ₀².
  double corner_coma_px = 0.77;
  /// Distance at which the middle of each image is in focus. Assumed: that of the windows sought.
  double focus_distance_m = 3.0;
  SpectralOptions spectrum;
  ImageSensorOptions sensor;
  ExposureOptions exposure;
  /// Whether each camera chooses its exposure by its own image, as cameras without a common
  /// controller do; otherwise both have that of the left one.
  bool own_exposure = true;
  bool as_designed = false;  ///< Whether the rig has no deviations; tolerances have no effect then.
  RigTolerances tolerances;
  RigMotion motion;
  HoverOptions hover;  ///< Added to the motion.
  /// Delay of the right camera's exposure after the left one's [s]. Both are triggered by one line
  /// (IDS, application note on synchronised uEye cameras); assumed: they answer to within the time
  /// of one row, 846 clocks of 27 MHz. By software it may be tens of milliseconds.
  double trigger_skew_s = 31e-6;
  /// Samples of pixels that more than one edge crosses; see RenderOptions.
  int edge_samples_per_pixel = 256;
};

/// Throws InputError with all faults.
void Validate(const StereoRigOptions& options);

/// The rig as designed, before any tolerance.
StereoCalibration DesignOf(const StereoRigOptions& options);

}  // namespace fenestra
