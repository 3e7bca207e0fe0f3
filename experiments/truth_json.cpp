#include "experiments/truth_json.h"

#include "core/geometry_json.h"

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

}  // namespace

std::string TruthJson(const GroundTruth& truth, const std::string& camera) {
  ordered_json json = {{"world_from_" + camera, ToJson(truth.X_WC)},
                       {"target_in_view", truth.in_view},
                       {"target", truth.target ? WindowJson(*truth.target) : ordered_json()},
                       {"other_windows", ordered_json::array()}};
  for (const WindowTruth& window : truth.other_windows) {
    json["other_windows"].push_back(WindowJson(window));
  }
  return json.dump(2) + "\n";
}

}  // namespace fenestra
