#include "experiments/trial_scene.h"

namespace fenestra {

Pose RigPoseOf(const TrialSettings& settings, const Scene& scene) {
  // Without a window the rig looks at the place where it would be: the world's origin.
  return RigPose(settings.viewpoint, scene.target ? scene.target->X_WO : Pose());
}

GltfScene TrialScene(const TrialSettings& settings) {
  GltfScene world{.scene = MakeScene(settings), .cameras = {}, .sun = {}, .notes = {}};
  const Pose X_WB = RigPoseOf(settings, world.scene);
  const StereoRig rig(settings.stereo);
  const StereoRig::TrueState nominal = rig.Nominal();
  const RgbdCalibration rgbd = StructuredLightSensor(settings.rgbd).nominal();
  world.cameras = {{.name = "left", .X_WC = X_WB * nominal.X_BL, .model = rig.nominal().left},
                   {.name = "right", .X_WC = X_WB * nominal.X_BR, .model = rig.nominal().right},
                   {.name = "depth", .X_WC = X_WB, .model = rgbd.depth},
                   {.name = "color", .X_WC = X_WB * rgbd.X_KD.inverse(), .model = rgbd.color}};
  if (settings.lighting.sun.illuminance_lx > 0.0) world.sun = settings.lighting.sun;
  return world;
}

}  // namespace fenestra
