#include "scenes/gltf/reader/instancing.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "scenes/gltf/file/values.h"
#include "scenes/gltf/reader/accessors.h"
#include "scenes/gltf/validation/instance_attributes.h"

namespace fenestra::gltf {
namespace {

using Eigen::Matrix4d;

std::vector<float> ReadAttribute(const Asset& asset, const tinygltf::Value& attributes,
                                 const char* name) {
  const tinygltf::Value* index = Find(attributes, {name});
  return index == nullptr ? std::vector<float>() : ReadFloats(asset, index->GetNumberAsInt());
}

}  // namespace

std::vector<Matrix4d> InstanceTransforms(const Asset& asset, const tinygltf::Node& node) {
  const tinygltf::Value* attributes = InstanceAttributes(node);
  if (attributes == nullptr) return {Matrix4d::Identity()};
  const std::vector<float> translations = ReadAttribute(asset, *attributes, "TRANSLATION");
  const std::vector<float> rotations = ReadAttribute(asset, *attributes, "ROTATION");
  const std::vector<float> scales = ReadAttribute(asset, *attributes, "SCALE");
  std::vector<Matrix4d> transforms(InstanceCount(asset.model, node), Matrix4d::Identity());
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
