#pragma once

#include <cstddef>

#include "core/io/faults.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// EXT_mesh_gpu_instancing: a node's mesh stands in many places, which accessors list as
/// TRANSLATION, ROTATION and SCALE in the node's axes.

/// The extension's `attributes`, or nullptr where a node lacks it.
const tinygltf::Value* InstanceAttributes(const tinygltf::Node& node);

/// That their types are the allowed ones and that they are equally long.
void CheckInstancing(const tinygltf::Model& model, Faults& faults);

/// 1 without the extension; nothing is read for it.
size_t InstanceCount(const tinygltf::Model& model, const tinygltf::Node& node);

}  // namespace fenestra::gltf
