#include <fmt/format.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "core/detection/detection_json.h"

namespace fenestra {
namespace {

using nlohmann::ordered_json;

constexpr size_t kMostOthers = 1000;
constexpr size_t kMostStages = 100;
constexpr size_t kLongestName = 64;
constexpr size_t kLongestDetail = 2000;

[[noreturn]] void Complain(const std::string& message) {
  throw std::runtime_error(message);
}

const ordered_json& Field(const ordered_json& json, const std::string& name) {
  const auto found = json.find(name);
  if (found == json.end()) Complain(fmt::format("'{}' is missing", name));
  return *found;
}

double ToNumber(const ordered_json& json, const std::string& what) {
  if (!json.is_number()) Complain(fmt::format("{} must be a number", what));
  return json.get<double>();
}

Eigen::Vector3d ToVector(const ordered_json& json, const std::string& what) {
  if (!json.is_array() || json.size() != 3) Complain(what + " must be three numbers");
  return {ToNumber(json[0], what), ToNumber(json[1], what), ToNumber(json[2], what)};
}

std::array<Eigen::Vector3d, 4> ToCorners(const ordered_json& json) {
  if (!json.is_array() || json.size() != 4) Complain("'corners_m' must be four points");
  std::array<Eigen::Vector3d, 4> corners;
  for (size_t i = 0; i < 4; ++i) corners[i] = ToVector(json[i], "a corner");
  return corners;
}

Eigen::Matrix3d ToMatrix(const ordered_json& json, const std::string& what) {
  if (!json.is_array() || json.size() != 3) Complain(what + " must be three rows of three numbers");
  Eigen::Matrix3d matrix;
  for (size_t i = 0; i < 3; ++i) {
    matrix.row(static_cast<Eigen::Index>(i)) = ToVector(json[i], "a row of " + what).transpose();
  }
  return matrix;
}

// The unit normal of the diagonals' plane, towards the camera. Corners that span no plane have
// none.
Eigen::Vector3d NormalOf(const std::array<Eigen::Vector3d, 4>& p_CV) {
  const Eigen::Vector3d across = (p_CV[2] - p_CV[0]).cross(p_CV[3] - p_CV[1]);
  if (!(across.norm() > 0.0)) Complain("'normal' is missing and the corners span no plane");
  const Eigen::Vector3d normal = across.normalized();
  return normal.dot(p_CV[0]) > 0.0 ? Eigen::Vector3d(-normal) : normal;
}

WindowEstimate ToEstimate(const ordered_json& json) {
  if (!json.is_object()) Complain("a window must be an object");
  WindowEstimate estimate;
  estimate.p_CO = ToVector(Field(json, "centroid_m"), "'centroid_m'");
  estimate.p_CV = ToCorners(Field(json, "corners_m"));
  estimate.normal_C =
      json.contains("normal") ? ToVector(json["normal"], "'normal'") : NormalOf(estimate.p_CV);
  if (json.contains("centroid_covariance_m2")) {
    estimate.covariance_C = ToMatrix(json["centroid_covariance_m2"], "'centroid_covariance_m2'");
  }
  if (json.contains("score")) estimate.score = ToNumber(json["score"], "'score'");
  return estimate;
}

WindowEstimate ToEstimateWithOthers(const ordered_json& json) {
  WindowEstimate estimate = ToEstimate(json);
  const auto others = json.find("others");
  if (others == json.end()) return estimate;
  if (!others->is_array() || others->size() > kMostOthers) {
    Complain(fmt::format("'others' must be a list of at most {} windows", kMostOthers));
  }
  for (const ordered_json& other : *others) estimate.others.push_back(ToEstimate(other));
  return estimate;
}

std::string ToText(const ordered_json& json, const std::string& name) {
  const ordered_json& field = Field(json, name);
  if (!field.is_string()) Complain(fmt::format("'{}' must be text", name));
  return field.get<std::string>();
}

Miss ToMiss(const ordered_json& json) {
  Miss miss{.reason = ToText(json, "reason"), .detail = {}};
  const bool good =
      !miss.reason.empty() && miss.reason.size() <= kLongestName &&
      miss.reason.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  if (!good) Complain("'reason' must be 1 to 64 of the characters a-z 0-9 _");
  if (json.contains("detail")) miss.detail = ToText(json, "detail").substr(0, kLongestDetail);
  return miss;
}

std::vector<StageTime> ToStages(const ordered_json& json) {
  const auto field = json.find("stage_seconds");
  if (field == json.end()) return {};
  if (!field->is_object() || field->size() > kMostStages) {
    Complain(fmt::format("'stage_seconds' must be an object of at most {} times", kMostStages));
  }
  std::vector<StageTime> stages;
  for (const auto& [stage, seconds] : field->items()) {
    const double time_s = ToNumber(seconds, "a time in 'stage_seconds'");
    if (!(time_s >= 0.0)) Complain("a time in 'stage_seconds' is negative");
    if (stage.empty() || stage.size() > kLongestName) {
      Complain("a name in 'stage_seconds' must have 1 to 64 bytes");
    }
    stages.push_back({stage, time_s});
  }
  return stages;
}

}  // namespace

TimedDetection DetectionFromJson(const ordered_json& json) {
  if (!json.is_object()) Complain("must be an object");
  const std::string outcome = ToText(json, "outcome");
  if (outcome == "window") return {ToEstimateWithOthers(json), ToStages(json)};
  if (outcome == "miss") return {ToMiss(json), ToStages(json)};
  Complain("'outcome' must be \"window\" or \"miss\"");
}

}  // namespace fenestra
