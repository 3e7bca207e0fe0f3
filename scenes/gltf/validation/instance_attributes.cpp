#include "scenes/gltf/validation/instance_attributes.h"

#include <fmt/format.h>

#include <string>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/file/values.h"

namespace fenestra::gltf {
namespace {

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
