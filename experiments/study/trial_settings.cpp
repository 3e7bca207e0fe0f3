#include "experiments/study/trial_settings.h"

#include "core/system/check.h"
#include "renderers/ray_caster.h"
#include "scenes/facade/facade_check.h"

namespace fenestra {

PaperTargetOptions PaperTargetOf(const TrialSettings& settings) {
  const WallOptions& wall = settings.facade.wall;
  const WindowOptions& window = settings.facade.window;
  return {.width_m = window.width_m,
          .height_m = window.height_m,
          .border_m = window.frame_width_m,
          .wall_width_m = wall.width_m,
          .wall_height_m = wall.height_m,
          .wall_reflectance = wall.paint.reflectance,
          .wall_reflectance_830nm = wall.paint.reflectance_830nm,
          .frame_reflectance = window.frame.reflectance,
          .frame_reflectance_830nm = window.frame.reflectance_830nm,
          .with_target = settings.facade.with_target};
}

Scene MakeScene(const TrialSettings& settings) {
  if (settings.scene == kPaperTargetScene) return MakePaperTarget(PaperTargetOf(settings));
  FENESTRA_CHECK(settings.scene == kFacadeScene, "unknown scene " + settings.scene);
  return MakeFacade(settings.facade);
}

UnitDeviations RgbdCalibrationChoice::deviations() const {
  switch (source) {
    case RgbdCalibrationSource::kExact:
      return {};
    case RgbdCalibrationSource::kPerturbed:
      return perturbed;
    case RgbdCalibrationSource::kFactory:
      return UnitDeviations::Factory();
  }
  FENESTRA_CHECK(false, "calibration source out of range");
}

bool EachTrialHasItsOwnSensor(const TrialSettings& settings, SensorKind sensor) {
  if (sensor == SensorKind::kStereo) return settings.stereo_rig_per_trial;
  return settings.rgbd_unit_per_trial &&
         settings.rgbd_calibration.source != RgbdCalibrationSource::kExact;
}

Pose RigPoseOf(const TrialSettings& settings, const Scene& scene) {
  // Without a window the rig looks at the place where it would be: the world's origin.
  return RigPose(settings.viewpoint, scene.target ? scene.target->X_WO : Pose());
}

void Validate(const TrialSettings& settings, SensorKind sensor) {
  if (settings.scene == kFacadeScene) {
    Validate(settings.facade);  // Made in full, textured facades would take too long.
  } else {
    MakeScene(settings);
  }
  if (sensor == SensorKind::kStereo) {
    Validate(settings.stereo);
    Validate(RenderOptions{.edge_samples_per_pixel = settings.stereo.edge_samples_per_pixel});
  } else {
    Validate(settings.rgbd);
    Validate(settings.rgbd_calibration.deviations());
    Validate(RenderOptions{.edge_samples_per_pixel = settings.rgbd.edge_samples_per_pixel});
  }
}

}  // namespace fenestra
