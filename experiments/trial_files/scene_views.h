#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/io/output_path.h"
#include "experiments/study/trial_settings.h"
#include "scenes/gltf/gltf.h"

namespace fenestra {

/// The world of a trial with the cameras of both sensors standing where the rig is: left, right,
/// depth, color, as designed.
GltfScene TrialScene(const TrialSettings& settings);

struct SceneViewOptions {
  std::optional<std::string> camera = {};  ///< By name; otherwise all of the scene's cameras.
  /// Size of the view that a scene without cameras is given.
  int width_px = 752;
  int height_px = 480;
  Lighting lighting = {};
  /// Views that are estimated to need more are refused before work begins.
  double most_seconds = 120.0;
  double most_bytes = 1e9;
};

/// The cameras that the options ask for. A scene without any is seen from the front: its target
/// from a distance of three times its larger side, or else all of it from above and to the side.
/// Throws InputError for a name that no camera has.
std::vector<SceneCamera> CamerasOf(const GltfScene& world, const SceneViewOptions& options);

/// Writes what each camera sees without a sensor, into a folder of its name:
///
///     color.png     sRGB; exposed such that 1 % of the pixels are white
///     infrared.png  the same at 830 nm
///     scene.exr     radiance in R, G, B and at 830 nm, and all per-pixel truth (see AovChannels)
///     truth.json    pose and windows
///
/// Throws InputError for views that need more than the options allow.
///
void WriteSceneViews(const OutputPath& folder, const GltfScene& world,
                     const SceneViewOptions& options);

}  // namespace fenestra
