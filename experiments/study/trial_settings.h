#pragma once

#include <string>

#include "core/detection/observation.h"
#include "core/geometry/calibration_board.h"
#include "scenes/facade/facade.h"
#include "scenes/lighting.h"
#include "scenes/scene.h"
#include "scenes/targets/board_shape.h"
#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"
#include "sim/stereo/stereo_rig.h"
#include "sim/structured_light/sensor_unit.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra {

/// Where a detector's knowledge of its stereo rig comes from.
enum class CalibrationSource {
  kExact,      ///< The true rig.
  kPerturbed,  ///< The true rig with a random error: what boards leave, and drift since then.
  kBoards,     ///< Calibrated with pictures of a board: intrinsics, extrinsics, errors and all.
               ///< These pictures have noise even if the rig's options leave it out.
  kStale,      ///< Calibrated with boards before the right camera was displaced.
  kDesign,     ///< The rig as designed: never calibrated.
};

struct CalibrationChoice {
  CalibrationSource source = CalibrationSource::kPerturbed;
  /// kPerturbed: drift of the right camera's pose since the calibration, standard deviations about
  /// and along each axis. The translation is what 12 K do to 35 cm of aluminium; the rotation is
  /// assumed. Focal lengths drift by 1e-4 for 10 K, a tenth of what boards leave of them.
  double rotation_error_rad = 1e-4;
  double translation_error_m = 1e-4;
  /// kPerturbed: noise of a corner's coordinate, in pictures that are not made. Adjusted together
  /// with their boards, two recorded sets keep 0.029 px (StereoPi's) and 0.073 px (OpenCV's).
  double corner_noise_px = 0.05;
  /// kPerturbed, kBoards, kStale.
  int boards = 20;
  BoardKind board = BoardKind::kChessboard;
  BoardTolerances board_tolerances{};
  /// Whether k3 is adjusted, as cv::calibrateCamera does by default, or taken to be 0. The rig does
  /// not say which of the two it needs.
  bool free_k3 = true;
  /// kStale: displacement of the right camera, standard deviations about and along each axis; what
  /// a hard landing does to a bar. Assumed.
  double shake_rotation_rad = 5e-4;
  double shake_translation_m = 1e-4;
};

/// Where a detector's knowledge of its RGB-D sensor comes from.
enum class RgbdCalibrationSource {
  kExact,      ///< All is as designed.
  kPerturbed,  ///< This unit was calibrated, with what errors that leaves.
  kFactory,    ///< The driver's constants, which are the same for all units.
};

/// The sensor is told as designed, and built with deviations.
struct RgbdCalibrationChoice {
  RgbdCalibrationSource source = RgbdCalibrationSource::kPerturbed;
  UnitDeviations perturbed = UnitDeviations::Calibrated();  ///< kPerturbed.

  UnitDeviations deviations() const;
};

inline constexpr const char* kPaperTargetScene = "paper_target";
inline constexpr const char* kFacadeScene = "facade";

/// Everything that one trial is made of, by value. Two equal settings and equal random streams
/// give equal observations.
struct TrialSettings {
  std::string scene = kPaperTargetScene;  ///< kPaperTargetScene or kFacadeScene.
  /// The window and the wall around it, for both kinds of scene: a facade has everything that the
  /// painted target has.
  FacadeOptions facade;
  Lighting lighting;
  Viewpoint viewpoint;
  StereoRigOptions stereo;
  CalibrationChoice stereo_calibration;
  /// Whether each trial has a stereo rig of its own, built and calibrated anew; otherwise all
  /// trials of the study share one.
  bool stereo_rig_per_trial = true;
  StructuredLightOptions rgbd;
  RgbdCalibrationChoice rgbd_calibration;
  /// Whether each trial has an RGB-D sensor of its own; otherwise all trials of the study share
  /// one.
  bool rgbd_unit_per_trial = true;
};

/// Whether each trial has a sensor of its own, built and told anew: an RGB-D sensor that is exactly
/// as told is always the same.
bool EachTrialHasItsOwnSensor(const TrialSettings& settings, SensorKind sensor);

/// The options of the painted target; frame_width_m is the width of its border.
PaperTargetOptions PaperTargetOf(const TrialSettings& settings);

/// The scene of a trial. Throws InputError for sizes that do not fit into each other.
Scene MakeScene(const TrialSettings& settings);

/// Where the rig's frame B stands.
Pose RigPoseOf(const TrialSettings& settings, const Scene& scene);

/// Throws InputError for settings that contradict each other, in the scene or in the sensor.
void Validate(const TrialSettings& settings, SensorKind sensor);

}  // namespace fenestra
