#include "scenes/gltf/validation/extensions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <regex>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/tinygltf.h"

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

// Version 2.0 is read, and later 2.x files that do not require their version.
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

const tinygltf::Accessor& AccessorOf(const tinygltf::Model& model, const tinygltf::Value& index) {
  return model.accessors[static_cast<size_t>(index.GetNumberAsInt())];
}

bool IsAllowed(const std::string& name, const tinygltf::Accessor& accessor) {
  const bool is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (name == "TRANSLATION" || name == "SCALE") {
    return accessor.type == TINYGLTF_TYPE_VEC3 && is_float;
  }
  const bool is_fraction =
      accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
                              accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT);
  return name.starts_with('_') ||
         (name == "ROTATION" && accessor.type == TINYGLTF_TYPE_VEC4 && (is_float || is_fraction));
}

void CheckNode(const tinygltf::Model& model, const tinygltf::Value& attributes,
               const std::string& at, Faults& faults) {
  const size_t count = AccessorOf(model, attributes.Get(attributes.Keys().front())).count;
  for (const std::string& name : attributes.Keys()) {
    const std::string pointer = at + MemberPointer(name);
    const tinygltf::Accessor& accessor = AccessorOf(model, attributes.Get(name));
    if (!IsAllowed(name, accessor)) {
      faults.Add(pointer,
                 "must be TRANSLATION, ROTATION or SCALE of a type that is allowed for it");
    }
    if (accessor.count != count) {
      faults.Add(pointer, fmt::format("has {} elements, while another attribute has {}",
                                      accessor.count, count));
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

const tinygltf::Value* InstanceAttributes(const tinygltf::Node& node) {
  const tinygltf::Value* extension = Extension(node.extensions, "EXT_mesh_gpu_instancing");
  return extension == nullptr ? nullptr : Find(*extension, {"attributes"});
}

void CheckInstancing(const tinygltf::Model& model, Faults& faults) {
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    const tinygltf::Value* attributes = InstanceAttributes(model.nodes[i]);
    if (attributes == nullptr) continue;
    CheckNode(model, *attributes,
              fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing/attributes", i), faults);
  }
}

size_t InstanceCount(const tinygltf::Model& model, const tinygltf::Node& node) {
  const tinygltf::Value* attributes = InstanceAttributes(node);
  if (attributes == nullptr) return 1;
  return AccessorOf(model, attributes->Get(attributes->Keys().front())).count;
}

}  // namespace fenestra::gltf
