#pragma once

#include <Eigen/Core>
#include <array>
#include <nlohmann/json.hpp>

#include "core/geometry/pose.h"

namespace fenestra {

/// Geometry as JSON: lists of numbers, matrices row by row, every double in the shortest form that
/// reads back with the same bits (-0.0 included). Numbers must be finite; JSON has no others.
nlohmann::ordered_json ToJson(const Eigen::Vector3d& v);
nlohmann::ordered_json ToJson(const Eigen::Matrix3d& m);
nlohmann::ordered_json ToJson(const std::array<Eigen::Vector3d, 4>& corners);
/// {"rotation": [[...], ...], "translation_m": [...]}
nlohmann::ordered_json ToJson(const Pose& X);

}  // namespace fenestra
