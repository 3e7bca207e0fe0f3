#pragma once

#include <string>

#include "sim/ground_truth.h"

namespace fenestra {

/// {"world_from_<camera>": pose, "target_in_view": …, "target": window or null, "other_windows":
/// […]} where a window has its centroid, corners and normal in the camera, and its sizes.
std::string TruthJson(const GroundTruth& truth, const std::string& camera);

}  // namespace fenestra
