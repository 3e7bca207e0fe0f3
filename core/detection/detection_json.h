#pragma once

#include <Eigen/Core>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/detection/detection.h"
#include "core/detection/stage_log.h"
#include "core/geometry/pose.h"

namespace fenestra {

/// Geometry as JSON: lists of numbers, matrices row by row, every double in the shortest form that
/// reads back with the same bits (-0.0 included). Numbers must be finite; JSON has no others.
nlohmann::ordered_json ToJson(const Eigen::Vector3d& v);
nlohmann::ordered_json ToJson(const Eigen::Matrix3d& m);
nlohmann::ordered_json ToJson(const std::array<Eigen::Vector3d, 4>& corners);
/// {"rotation": [[...], ...], "translation_m": [...]}
nlohmann::ordered_json ToJson(const Pose& X);

/// A detection as JSON, metres in the scored camera's frame, all digits of every double:
///
///     {"outcome": "window", "centroid_m": [x, y, z],
///      "corners_m": [[x, y, z], ...],            top left, top right, bottom right, bottom left
///      "normal": [x, y, z],                      as read: that of the corners, if it is missing
///      "centroid_covariance_m2": [[...], ...],   optional, 3 x 3
///      "size_m": [width, height],                not read
///      "score": s, "others": [{...}, ...],       optional
///      "stage_seconds": {"match": 0.04, ...}}    optional
///     {"outcome": "miss", "reason": "no_contour", "detail": "for people", "stage_seconds": {...}}
nlohmann::ordered_json ToJson(const Detection& detection, const std::vector<StageTime>& stages);

struct TimedDetection {
  Detection detection;
  std::vector<StageTime> stages;
};

/// The inverse of ToJson. Ignores keys that are not named above. Throws std::runtime_error, with
/// the reason, for a missing key, a wrong shape, a reason that is not snake_case or a negative
/// time.
TimedDetection DetectionFromJson(const nlohmann::ordered_json& json);

/// The JSON of a detection with the detector's name before it, for people and programs.
std::string DetectionJson(const std::string& detector, const Detection& detection,
                          const StageLog& log);

/// A detection and the times of its stages as text for people.
std::string DetectionText(const std::string& detector, const Detection& detection,
                          const StageLog& log);

}  // namespace fenestra
