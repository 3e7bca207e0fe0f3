#include "scenes/gltf/validation/extensions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <regex>

namespace fenestra::gltf {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 9> kSupported = {
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual",        "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_mesh_quantization",   "KHR_node_visibility",        "KHR_texture_transform"};

std::vector<std::string> Names(const json& root, const char* member) {
  std::vector<std::string> names;
  const auto found = root.find(member);
  if (found == root.end() || !found->is_array()) return names;
  for (const json& name : *found) {
    if (name.is_string()) names.push_back(name.get<std::string>());
  }
  return names;
}

// 2.0 is read, and later 2.x files that do not insist on their version.
void CheckVersion(const json& asset, Faults& faults) {
  for (const char* member : {"version", "minVersion"}) {
    const auto found = asset.find(member);
    if (found == asset.end() || !found->is_string()) continue;
    const auto version = found->get<std::string>();
    const std::string pointer = fmt::format("/asset/{}", member);
    if (!std::regex_match(version, std::regex("[0-9]{1,9}\\.[0-9]{1,9}"))) {
      faults.Add(pointer, fmt::format("'{}' is not a version such as 2.0", version));
    } else if (std::stoi(version) != 2) {
      faults.Add(pointer, fmt::format("glTF {} is not read; 2.0 is", version));
    } else if (member == std::string_view("minVersion") && version != "2.0") {
      faults.Add(pointer, fmt::format("needs a reader of glTF {}; this one reads 2.0", version));
    }
  }
}

}  // namespace

bool IsSupported(std::string_view extension) {
  return std::ranges::find(kSupported, extension) != kSupported.end();
}

std::set<std::string> DeclaredExtensions(const json& root) {
  const std::vector<std::string> used = Names(root, "extensionsUsed");
  return {used.begin(), used.end()};
}

void CheckVersionAndExtensions(const json& root, Faults& faults) {
  const auto asset = root.find("asset");
  if (asset != root.end() && asset->is_object()) CheckVersion(*asset, faults);
  const std::vector<std::string> required = Names(root, "extensionsRequired");
  const std::set<std::string> declared = DeclaredExtensions(root);
  for (size_t i = 0; i < required.size(); ++i) {
    const std::string pointer = fmt::format("/extensionsRequired/{}", i);
    if (!IsSupported(required[i])) {
      faults.Add(pointer, fmt::format("the file requires {}, which is not supported; supported are "
                                      "{}",
                                      required[i], fmt::join(kSupported, ", ")));
    }
    if (!declared.contains(required[i])) {
      faults.Add(pointer, fmt::format("{} is not in 'extensionsUsed'", required[i]));
    }
  }
}

std::vector<std::string> IgnoredExtensions(const json& root) {
  std::vector<std::string> ignored = Names(root, "extensionsUsed");
  std::erase_if(ignored, [](const std::string& name) { return IsSupported(name); });
  return ignored;
}

}  // namespace fenestra::gltf
