#include "core/geometry/geometry_json.h"

#include "core/system/check.h"

namespace fenestra {

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

}  // namespace fenestra
