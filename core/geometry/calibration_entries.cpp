#include "core/geometry/calibration_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace fenestra {
namespace {

// In lower case, letters and digits alone: programs write plumb_bob, Plumb Bob and plumb-bob.
std::string Bare(const YAML::Node& node) {
  std::string bare;
  if (!node.IsScalar()) return bare;
  for (const char c : node.Scalar()) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0) bare += static_cast<char>(std::tolower(byte));
  }
  return bare;
}

template <size_t n>
bool IsOneOf(const std::string& word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

template <size_t n>
bool ContainsOneOf(const std::string& word, const std::array<std::string_view, n>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&word](std::string_view part) {
    return word.find(part) != std::string::npos;
  });
}

constexpr std::array<std::string_view, 4> kModelEntries = {"distortionmodel", "distortiontype",
                                                           "lensmodel", "projectionmodel"};
// As OpenCV, ROS, Kalibr, COLMAP and others call it. Of a rational polynomial the coefficients
// beyond k3 must be 0, and so it is the same.
constexpr std::array<std::string_view, 15> kBrownConradyNames = {
    "plumbbob", "radtan",   "radialtangential", "brown",       "brownconrady",
    "opencv",   "pinhole",  "radial",           "perspective", "rectilinear",
    "none",     "standard", "pinholeradtan",    "fullopencv",  "rationalpolynomial"};
// Where the camera's product is called as well, only what is known as another lens counts.
constexpr std::array<std::string_view, 2> kCameraEntries = {"cameramodel", "cameratype"};
constexpr std::array<std::string_view, 8> kOtherModels = {
    "fisheye", "equidistant", "omni", "eucm", "doublesphere", "kannala", "scaramuzza", "spherical"};
constexpr std::array<std::string_view, 3> kOtherLensEntries = {"fisheye", "equidistant",
                                                               "omnidirectional"};
constexpr std::array<std::string_view, 5> kNo = {"false", "0", "no", "off", ""};
constexpr std::array<std::string_view, 10> kUnitEntries = {
    "unit",  "lengthunit",  "translationunit",  "baselineunit",  "tunit",
    "units", "lengthunits", "translationunits", "baselineunits", "tunits"};
constexpr std::array<std::string_view, 12> kNotMetres = {
    "mm", "millimeter", "millimeters", "millimetre", "millimetres", "cm",
    "um", "centimeter", "centimetre",  "inch",       "inches",      "feet"};

// A scalar, or each scalar of a list: one for each camera.
template <typename Check>
void ForEachScalar(const YAML::Node& node, const Check& check) {
  if (node.IsScalar()) check(node);
  if (!node.IsSequence()) return;
  for (const YAML::Node& item : node) {
    if (item.IsScalar()) check(item);
  }
}

void CheckStatement(YamlReader& reader, const YAML::Node& key, const YAML::Node& value) {
  const std::string name = Bare(key);
  const auto another_lens = [&] {
    reader.AddFault(value,
                    fmt::format("{}: {} is another lens model; coefficients are read as k1 k2 p1 "
                                "p2 [k3] of Brown and Conrady (plumb_bob)",
                                YamlReader::Describe(key), YamlReader::Describe(value)));
  };
  if (ContainsOneOf(name, kModelEntries)) {
    ForEachScalar(value, [&](const YAML::Node& model) {
      if (!IsOneOf(Bare(model), kBrownConradyNames)) another_lens();
    });
  } else if (ContainsOneOf(name, kCameraEntries)) {
    ForEachScalar(value, [&](const YAML::Node& model) {
      if (ContainsOneOf(Bare(model), kOtherModels) || Bare(model) == "ds") another_lens();
    });
  } else if (ContainsOneOf(name, kOtherLensEntries)) {
    if (!value.IsNull() && !(value.IsScalar() && IsOneOf(Bare(value), kNo))) another_lens();
  } else if (IsOneOf(name, kUnitEntries)) {
    ForEachScalar(value, [&](const YAML::Node& unit) {
      if (!IsOneOf(Bare(unit), kNotMetres)) return;
      reader.AddFault(unit, fmt::format("{}: lengths are read in metres, not in {}",
                                        YamlReader::Describe(key), YamlReader::Describe(unit)));
    });
  }
}

void CheckMapping(YamlReader& reader, const YAML::Node& mapping) {
  std::set<std::string> seen;
  for (const auto& entry : mapping) {
    if (!entry.first.IsScalar()) continue;
    if (!seen.insert(entry.first.Scalar()).second) {
      reader.AddFault(entry.first,
                      fmt::format("{} stands twice", YamlReader::Describe(entry.first)));
    }
    CheckStatement(reader, entry.first, entry.second);
    if (entry.second.IsMap()) CheckMapping(reader, entry.second);
  }
}

}  // namespace

void CheckStatements(YamlReader& reader) {
  if (reader.root().IsMap()) CheckMapping(reader, reader.root());
}

void CheckDepthUnitIsStatedAsKnown(YamlReader& reader) {
  static const std::vector<std::string> known = {"depth_unit_m"};
  constexpr std::array<std::string_view, 3> kMeasures = {"unit", "scale", "factor"};
  for (const auto& entry : reader.root()) {
    if (!entry.first.IsScalar() || entry.first.Scalar() == known.front()) continue;
    const std::string name = Bare(entry.first);
    const bool alike = name.find("depth") != std::string::npos && ContainsOneOf(name, kMeasures);
    if (!alike && DidYouMean(entry.first.Scalar(), known).empty()) continue;
    reader.AddFault(entry.first,
                    fmt::format("unknown entry {}. Did you mean 'depth_unit_m'? It is the metres "
                                "per unit of the depth image",
                                YamlReader::Describe(entry.first)));
  }
}

bool StatesDepthUnit(const std::filesystem::path& file) {
  const YamlReader reader = YamlReader::FromFile(file);
  return reader.root().IsMap() && reader.root()["depth_unit_m"].IsDefined();
}

std::optional<std::string> DepthUnitObjection(double depth_unit_m) {
  constexpr double kSmallest_m = 1e-6;  // The largest of 16 bits would be 7 cm away.
  constexpr double kLargest_m = 0.05;
  if (depth_unit_m >= kSmallest_m && depth_unit_m <= kLargest_m) return std::nullopt;
  return fmt::format("a unit of depth must be of {:g} to {:g} m, not of {:g} m", kSmallest_m,
                     kLargest_m, depth_unit_m);
}

void CheckFormat(YamlReader& reader) {
  const YAML::Node& root = reader.root();
  if (!root.IsMap()) {
    reader.AddFault(root, "must be a mapping of calibration entries");
  } else if (root["K1"].IsDefined() || root["K_color"].IsDefined()) {
    return;
  } else if (root["camera_matrix"].IsDefined() || root["K"].IsDefined()) {
    reader.AddFault(root,
                    "is the camera_info of a single camera (ROS); docs/stereo.md says how the "
                    "files of a pair become one calibration");
  } else if (root["cam0"].IsDefined()) {
    reader.AddFault(root,
                    "is a camera chain of Kalibr; docs/stereo.md says how it becomes a "
                    "calibration");
  }
  reader.ThrowIfFaulty();
}

}  // namespace fenestra
