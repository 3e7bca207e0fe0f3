#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/detection/stage_log.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// The nested fields of a TrialRecord as JSON text, for the columns of a database. Every double
/// reads back with the same bits. The readers throw std::runtime_error for any other text.

/// {"distance_m": 1.4, "scene": "facade", "glass": true}, in the given order. Numbers that JSON
/// does not have are written as {"number": "inf"} ("-inf", "nan").
std::string FactorsToJson(const FactorValues& factors);
FactorValues FactorsFromJson(const std::string& text);

/// {"rectify": 0.0123, "match": 0.041}: seconds, in the given order.
std::string StageTimesToJson(const std::vector<StageTime>& stages);
std::vector<StageTime> StageTimesFromJson(const std::string& text);

/// [[x, y, z], ...] for four corners.
std::string CornersToJson(const std::array<Eigen::Vector3d, 4>& corners);
std::array<Eigen::Vector3d, 4> CornersFromJson(const std::string& text);

/// [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]].
std::string MatrixToJson(const Eigen::Matrix3d& matrix);
Eigen::Matrix3d MatrixFromJson(const std::string& text);

}  // namespace fenestra
