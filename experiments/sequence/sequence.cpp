#include "experiments/sequence/sequence.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <vector>

namespace fenestra {
namespace {

constexpr double kFarthest_m = 1e4;
constexpr double kLargestSide_m = 100.0;

// An undefined node, and a fault, where the key is missing.
YAML::Node Required(YamlReader& reader, const YAML::Node& node, const std::string& key) {
  const YAML::Node found = node[key];
  if (!found.IsDefined()) reader.AddFault(node, fmt::format("a window needs {}", key));
  return found;
}

double ReadSide(YamlReader& reader, const YAML::Node& node, const std::string& key) {
  const YAML::Node side = Required(reader, node, key);
  if (!side.IsDefined()) return 1.0;
  const double side_m = reader.Number(side, key).value_or(1.0);
  if (!(side_m > 0.0 && side_m <= kLargestSide_m)) {
    reader.AddFault(side, fmt::format("{} must be above 0 and at most {} (metres), not {}", key,
                                      kLargestSide_m, side_m));
  }
  return side_m;
}

WindowTruth ReadWindow(YamlReader& reader, const YAML::Node& node) {
  WindowTruth window{};
  const YAML::Node centroid = Required(reader, node, "centroid_m");
  if (centroid.IsDefined()) {
    const auto numbers = reader.Numbers(centroid, "centroid_m", 3);
    if (numbers) window.p_CO = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    if (numbers && !(window.p_CO.norm() <= kFarthest_m)) {
      reader.AddFault(centroid, fmt::format("centroid_m lies farther away than {} m", kFarthest_m));
    }
  }
  window.width_m = ReadSide(reader, node, "width_m");
  window.height_m = ReadSide(reader, node, "height_m");
  return window;
}

std::vector<WindowTruth> ReadOthers(YamlReader& reader, const YAML::Node& node) {
  if (!node.IsDefined()) return {};
  if (!node.IsSequence()) {
    reader.AddFault(node, "other_windows must be a list of windows");
    return {};
  }
  std::vector<WindowTruth> others;
  static const std::vector<std::string> keys{"centroid_m", "width_m", "height_m"};
  for (const YAML::Node& other : node) {
    if (reader.CheckKeys(other, "another window", keys)) {
      others.push_back(ReadWindow(reader, other));
    }
  }
  return others;
}

// The entries of a window in a map. Numbers have the shortest form that reads back exactly, which
// the emitter's own do not.
YAML::Emitter& operator<<(YAML::Emitter& yaml, const WindowTruth& window) {
  const auto shortest = [](double number) { return fmt::format("{}", number); };
  yaml << "centroid_m" << YAML::BeginSeq;
  for (const double coordinate_m : window.p_CO) yaml << shortest(coordinate_m);
  yaml << YAML::EndSeq;
  return yaml << "width_m" << shortest(window.width_m) << "height_m" << shortest(window.height_m);
}

}  // namespace

GroundTruth ReadSurveyedTruth(YamlReader& reader, const YAML::Node& node) {
  GroundTruth truth{.X_WC = Pose(), .target = {}, .other_windows = {}};
  if (node.IsScalar() && node.Scalar() == "none") return truth;
  static const std::vector<std::string> keys{"centroid_m", "width_m", "height_m", "in_view",
                                             "other_windows"};
  if (!node.IsMap()) {
    reader.AddFault(node, fmt::format("truth must be none or a mapping with centroid_m, width_m "
                                      "and height_m, not {}",
                                      YamlReader::Describe(node)));
    return truth;
  }
  const size_t before = reader.fault_count();
  reader.CheckKeys(node, "a truth", keys);
  truth.other_windows = ReadOthers(reader, node["other_windows"]);
  // Other windows alone: there is no target.
  if (node.size() == 1 && node["other_windows"].IsDefined()) return truth;
  truth.target = ReadWindow(reader, node);
  truth.in_view = true;
  if (const YAML::Node in_view = node["in_view"]; in_view.IsDefined()) {
    truth.in_view = reader.Boolean(in_view, "in_view").value_or(false);
  }
  if (truth.in_view && reader.fault_count() == before && !(truth.target->p_CO.z() > 0.0)) {
    reader.AddFault(node["centroid_m"],
                    fmt::format("centroid_m lies behind the camera: z points along the optical "
                                "axis and must be above 0, not {}",
                                truth.target->p_CO.z()));
  }
  return truth;
}

std::string ToYaml(const GroundTruth& truth) {
  if (!truth.target && truth.other_windows.empty()) return "none";
  YAML::Emitter yaml;
  yaml << YAML::Flow << YAML::BeginMap;
  if (truth.target) yaml << *truth.target << "in_view" << truth.in_view;
  if (!truth.other_windows.empty()) yaml << "other_windows" << YAML::BeginSeq;
  for (const WindowTruth& other : truth.other_windows) {
    yaml << YAML::BeginMap << other << YAML::EndMap;
  }
  if (!truth.other_windows.empty()) yaml << YAML::EndSeq;
  yaml << YAML::EndMap;
  return yaml.c_str();
}

}  // namespace fenestra
