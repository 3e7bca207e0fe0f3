#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// {"world_from_<camera>": pose, "target_in_view": …, "target": window or null, "other_windows":
/// […]} where a window has its centroid, corners and normal in the camera, and its sizes.
std::string TruthJson(const GroundTruth& truth, const std::string& camera);

/// The cameras of a sensor, the scored one first.
struct NamedCamera {
  std::string name;
  CameraModel camera;
  Pose X_WC;
};

/// TruthJson of a trial whose true cameras are known, with further members:
///
///     camera                      the scored one, in whose frame the windows are: "left", "depth"
///     world_from_<camera>         of every camera
///     world_from_target           the window's frame O: x to the right and y up as seen from
///                                 before the wall, z the normal; absent without a target
///     target_visible_share        see VisibleShare; absent without a target
///     target.corners_px           by camera, where its image has each corner; null behind it
std::string TruthJson(const GroundTruth& truth, std::span<const NamedCamera> cameras,
                      std::optional<double> target_visible_share);

}  // namespace fenestra
