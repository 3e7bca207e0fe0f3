#include "core/detection/detection_json.h"

#include <fmt/format.h>

#include "core/system/check.h"

namespace fenestra {
namespace {

using nlohmann::ordered_json;

ordered_json EstimateJson(const WindowEstimate& estimate) {
  ordered_json json = {{"centroid_m", ToJson(estimate.p_CO)},
                       {"corners_m", ToJson(estimate.p_CV)},
                       {"normal", ToJson(estimate.normal_C)}};
  if (estimate.covariance_C) json["centroid_covariance_m2"] = ToJson(*estimate.covariance_C);
  json["size_m"] = {(estimate.p_CV[1] - estimate.p_CV[0]).norm(),
                    (estimate.p_CV[3] - estimate.p_CV[0]).norm()};
  if (estimate.score) json["score"] = *estimate.score;
  for (const WindowEstimate& other : estimate.others) {
    json["others"].push_back(EstimateJson(other));
  }
  return json;
}

}  // namespace

using nlohmann::ordered_json;

ordered_json ToJson(const Eigen::Vector3d& v) {
  FENESTRA_CHECK(v.allFinite(), "JSON has no number for it");
  return {v.x(), v.y(), v.z()};
}

ordered_json ToJson(const Eigen::Matrix3d& m) {
  ordered_json rows = ordered_json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(ToJson(Eigen::Vector3d(m.row(i))));
  return rows;
}

ordered_json ToJson(const std::array<Eigen::Vector3d, 4>& corners) {
  ordered_json list = ordered_json::array();
  for (const Eigen::Vector3d& corner : corners) list.push_back(ToJson(corner));
  return list;
}

ordered_json ToJson(const Pose& X) {
  return {{"rotation", ToJson(X.rotation())}, {"translation_m", ToJson(X.translation())}};
}

ordered_json ToJson(const Detection& detection, const std::vector<StageTime>& stages) {
  ordered_json json;
  if (const auto* miss = std::get_if<Miss>(&detection)) {
    json = {{"outcome", "miss"}, {"reason", miss->reason}, {"detail", miss->detail}};
  } else {
    json["outcome"] = "window";
    json.update(EstimateJson(std::get<WindowEstimate>(detection)));
  }
  for (const StageTime& time : stages) json["stage_seconds"][time.stage] = time.seconds;
  return json;
}

std::string DetectionJson(const std::string& detector, const Detection& detection,
                          const StageLog& log) {
  ordered_json json = {{"detector", detector}};
  json.update(ToJson(detection, log.times()));
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string DetectionText(const std::string& detector, const Detection& detection,
                          const StageLog& log) {
  std::string text;
  if (const auto* miss = std::get_if<Miss>(&detection)) {
    text = fmt::format("{}: no window ({}: {})\n", detector, miss->reason, miss->detail);
  } else {
    const auto& e = std::get<WindowEstimate>(detection);
    text = fmt::format(
        "{}: window at x {:.4f} m (right), y {:.4f} m (down), z {:.4f} m (ahead)\n"
        "  about {:.3f} m wide and {:.3f} m high\n",
        detector, e.p_CO.x(), e.p_CO.y(), e.p_CO.z(), (e.p_CV[1] - e.p_CV[0]).norm(),
        (e.p_CV[3] - e.p_CV[0]).norm());
  }
  for (const StageTime& time : log.times()) {
    text += fmt::format("  {:<12} {:7.1f} ms\n", time.stage, 1e3 * time.seconds);
  }
  return text + fmt::format("  {:<12} {:7.1f} ms\n", "total", 1e3 * log.TotalSeconds());
}

}  // namespace fenestra
