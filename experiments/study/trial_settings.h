#pragma once

#include <string>

#include "core/detection/observation.h"
#include "experiments/study/calibration_choice.h"
#include "scenes/facade/facade.h"
#include "scenes/lighting.h"
#include "scenes/scene.h"
#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"
#include "sim/stereo/stereo_rig.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra {

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
};

/// The options of the painted target; frame_width_m is the width of its border.
PaperTargetOptions PaperTargetOf(const TrialSettings& settings);

/// The scene of a trial. Throws InputError for sizes that do not fit into each other.
Scene MakeScene(const TrialSettings& settings);

/// Throws InputError for settings that contradict each other, in the scene or in the sensor.
void Validate(const TrialSettings& settings, SensorKind sensor);

}  // namespace fenestra
