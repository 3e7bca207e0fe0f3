#include "experiments/trial_files/truth_json.h"

#include "core/detection/detection_json.h"

namespace fenestra {
namespace {

using nlohmann::ordered_json;

ordered_json WindowJson(const WindowTruth& window) {
  return {{"centroid_m", ToJson(window.p_CO)},
          {"corners_m", ToJson(window.p_CV)},
          {"normal", ToJson(window.normal_C)},
          {"width_m", window.width_m},
          {"height_m", window.height_m}};
}

// The frame O of a window: x right and y up along its sides, z its normal.
Pose X_CO(const WindowTruth& window) {
  Eigen::Matrix3d R_CO;
  R_CO.col(0) = (window.p_CV[1] - window.p_CV[0]).normalized();
  R_CO.col(2) = window.normal_C;
  R_CO.col(1) = R_CO.col(2).cross(R_CO.col(0));
  return Pose(R_CO, window.p_CO);
}

ordered_json CornersPx(const WindowTruth& window, const Pose& X_WC, const NamedCamera& camera) {
  const Pose X_KC = camera.X_WC.inverse() * X_WC;
  ordered_json corners = ordered_json::array();
  for (const Eigen::Vector3d& p_CV : window.p_CV) {
    const auto pixel = camera.camera.Project(X_KC * p_CV);
    corners.push_back(pixel ? ordered_json{pixel->x(), pixel->y()} : ordered_json());
  }
  return corners;
}

ordered_json Windows(const GroundTruth& truth) {
  ordered_json json = {{"target_in_view", truth.in_view},
                       {"target", truth.target ? WindowJson(*truth.target) : ordered_json()},
                       {"other_windows", ordered_json::array()}};
  for (const WindowTruth& window : truth.other_windows) {
    json["other_windows"].push_back(WindowJson(window));
  }
  return json;
}

}  // namespace

std::string TruthJson(const GroundTruth& truth, const std::string& camera) {
  ordered_json json = {{"world_from_" + camera, ToJson(truth.X_WC)}};
  json.update(Windows(truth));
  return json.dump(2) + "\n";
}

std::string TruthJson(const GroundTruth& truth, std::span<const NamedCamera> cameras,
                      std::optional<double> target_visible_share) {
  ordered_json json = {{"camera", cameras.front().name}};
  for (const NamedCamera& camera : cameras) {
    json["world_from_" + camera.name] = ToJson(camera.X_WC);
  }
  if (truth.target) {
    json["world_from_target"] = ToJson(truth.X_WC * X_CO(*truth.target));
    json["target_visible_share"] = target_visible_share.value();
  }
  json.update(Windows(truth));
  if (truth.target) {
    for (const NamedCamera& camera : cameras) {
      json["target"]["corners_px"][camera.name] = CornersPx(*truth.target, truth.X_WC, camera);
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace fenestra
