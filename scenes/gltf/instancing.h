#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/faults.h"
#include "scenes/gltf/asset.h"

namespace fenestra::gltf {

/// EXT_mesh_gpu_instancing: a node's mesh stands in many places, which accessors list as
/// TRANSLATION, ROTATION and SCALE in the node's axes.

/// That their types are the allowed ones and that they are equally long.
void CheckInstancing(const tinygltf::Model& model, Faults& faults);

/// 1 without the extension; nothing is read for it.
size_t InstanceCount(const Asset& asset, const tinygltf::Node& node);

/// M_NI of each instance I; the identity without the extension. Throws InputError for a rotation
/// that is none.
std::vector<Eigen::Matrix4d> InstanceTransforms(const Asset& asset, const tinygltf::Node& node);

}  // namespace fenestra::gltf
