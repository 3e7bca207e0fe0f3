#include "experiments/trial_settings.h"

#include "core/check.h"
#include "renderers/ray_caster.h"

namespace fenestra {

PaperTargetOptions PaperTargetOf(const TrialSettings& settings) {
  const FacadeOptions& window = settings.window;
  return {.width_m = window.width_m,
          .height_m = window.height_m,
          .border_m = window.frame_width_m,
          .wall_width_m = window.wall_width_m,
          .wall_height_m = window.wall_height_m,
          .wall_reflectance = window.wall_reflectance,
          .wall_reflectance_830nm = window.wall_reflectance_830nm,
          .frame_reflectance = window.frame_reflectance,
          .frame_reflectance_830nm = window.frame_reflectance_830nm,
          .with_target = window.with_target};
}

Scene MakeScene(const TrialSettings& settings) {
  if (settings.scene == kPaperTargetScene) return MakePaperTarget(PaperTargetOf(settings));
  FENESTRA_CHECK(settings.scene == kFacadeScene, "unknown scene " + settings.scene);
  return MakeFacade(settings.window);
}

void Validate(const TrialSettings& settings, SensorKind sensor) {
  MakeScene(settings);
  if (sensor == SensorKind::kStereo) {
    Validate(settings.stereo);
    Validate(RenderOptions{.edge_samples_per_pixel = settings.stereo.edge_samples_per_pixel});
  } else {
    Validate(settings.rgbd);
    Validate(RenderOptions{.edge_samples_per_pixel = settings.rgbd.edge_samples_per_pixel});
  }
}

}  // namespace fenestra
