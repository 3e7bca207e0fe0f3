#pragma once

#include "experiments/study/trial_settings.h"
#include "scenes/gltf/gltf.h"

namespace fenestra {

/// Where the rig's frame B stands.
Pose RigPoseOf(const TrialSettings& settings, const Scene& scene);

/// The world of a trial with the cameras of both sensors standing where the rig is: left, right,
/// depth, color, as designed.
GltfScene TrialScene(const TrialSettings& settings);

}  // namespace fenestra
