#include "scenes/gltf/instancing.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "scenes/gltf/accessors.h"
#include "scenes/gltf/document.h"
#include "scenes/gltf/values.h"

namespace fenestra::gltf {
namespace {

using Eigen::Matrix4d;

const tinygltf::Value* Attributes(const tinygltf::Node& node) {
  const tinygltf::Value* extension = Extension(node.extensions, "EXT_mesh_gpu_instancing");
  return extension == nullptr ? nullptr : Find(*extension, {"attributes"});
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

std::vector<float> ReadAttribute(const Asset& asset, const tinygltf::Value& attributes,
                                 const char* name) {
  const tinygltf::Value* index = Find(attributes, {name});
  return index == nullptr ? std::vector<float>() : ReadFloats(asset, index->GetNumberAsInt());
}

}  // namespace

void CheckInstancing(const tinygltf::Model& model, Faults& faults) {
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    const tinygltf::Value* attributes = Attributes(model.nodes[i]);
    if (attributes == nullptr) continue;
    CheckNode(model, *attributes,
              fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing/attributes", i), faults);
  }
}

size_t InstanceCount(const Asset& asset, const tinygltf::Node& node) {
  const tinygltf::Value* attributes = Attributes(node);
  if (attributes == nullptr) return 1;
  return AccessorOf(asset.model, attributes->Get(attributes->Keys().front())).count;
}

std::vector<Matrix4d> InstanceTransforms(const Asset& asset, const tinygltf::Node& node) {
  const tinygltf::Value* attributes = Attributes(node);
  if (attributes == nullptr) return {Matrix4d::Identity()};
  const std::vector<float> translations = ReadAttribute(asset, *attributes, "TRANSLATION");
  const std::vector<float> rotations = ReadAttribute(asset, *attributes, "ROTATION");
  const std::vector<float> scales = ReadAttribute(asset, *attributes, "SCALE");
  std::vector<Matrix4d> transforms(InstanceCount(asset, node), Matrix4d::Identity());
  for (size_t i = 0; i < transforms.size(); ++i) {
    Eigen::Affine3d X = Eigen::Affine3d::Identity();
    if (!translations.empty()) {
      X.translate(Eigen::Map<const Eigen::Vector3f>(&translations[3 * i]).cast<double>());
    }
    if (!rotations.empty()) {
      const Eigen::Quaterniond q =
          Eigen::Map<const Eigen::Quaternionf>(&rotations[4 * i]).cast<double>();
      if (!(q.norm() > 0.0)) {
        throw InputError(asset.file, fmt::format("node '{}': the rotation of instance {} is zero",
                                                 node.name, i));
      }
      X.rotate(q.normalized());
    }
    if (!scales.empty()) {
      X.scale(Eigen::Map<const Eigen::Vector3f>(&scales[3 * i]).cast<double>());
    }
    transforms[i] = X.matrix();
  }
  return transforms;
}

}  // namespace fenestra::gltf
