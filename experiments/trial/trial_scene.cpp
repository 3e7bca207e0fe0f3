#include "experiments/trial/trial_scene.h"

namespace fenestra {

Pose RigPoseOf(const TrialSettings& settings, const Scene& scene) {
  // Without a window the rig looks at the place where it would be: the world's origin.
  return RigPose(settings.viewpoint, scene.target ? scene.target->X_WO : Pose());
}

GltfScene TrialScene(const TrialSettings& settings) {
  GltfScene world{.scene = MakeScene(settings), .cameras = {}, .sun = {}, .notes = {}};
  const Pose X_WB = RigPoseOf(settings, world.scene);
  const StereoCalibration stereo = DesignOf(settings.stereo);
  const Pose X_BL = Pose::Translation({-0.5 * settings.stereo.baseline_m, 0.0, 0.0});
  const Pose X_BR = X_BL * stereo.X_RL.inverse();
  const StructuredLightSensor sensor(settings.rgbd);
  const RgbdCalibration& rgbd = sensor.nominal();
  world.cameras = {{.name = "left", .X_WC = X_WB * X_BL, .model = stereo.left},
                   {.name = "right", .X_WC = X_WB * X_BR, .model = stereo.right},
                   {.name = "depth", .X_WC = sensor.X_WD(X_WB), .model = rgbd.depth},
                   {.name = "color", .X_WC = sensor.X_WK(X_WB), .model = rgbd.color}};
  if (settings.lighting.sun.illuminance_lx > 0.0) world.sun = settings.lighting.sun;
  return world;
}

}  // namespace fenestra
