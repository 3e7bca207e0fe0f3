#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/gltf/reader/asset.h"

namespace fenestra::gltf {

/// M_NI of each instance I of a node's mesh (see InstanceAttributes); the identity without the
/// extension. Throws InputError for a rotation that is none.
std::vector<Eigen::Matrix4d> InstanceTransforms(const Asset& asset, const tinygltf::Node& node);

}  // namespace fenestra::gltf
