#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/faults.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// Whether Fenestra understands the extension, so that a file may require it.
bool IsSupported(std::string_view extension);

/// The names in the document's `extensionsUsed`.
std::set<std::string> DeclaredExtensions(const nlohmann::json& root);

/// Checks the version, and that all required extensions are supported and declared.
void CheckVersionAndExtensions(const nlohmann::json& root, Faults& faults);

/// Extensions that the document uses and Fenestra leaves out.
std::vector<std::string> IgnoredExtensions(const nlohmann::json& root);

/// EXT_mesh_gpu_instancing: a node's mesh stands in many places, which accessors list as
/// TRANSLATION, ROTATION and SCALE in the node's axes.

/// The extension's `attributes`, or nullptr where a node lacks it.
const tinygltf::Value* InstanceAttributes(const tinygltf::Node& node);

/// Checks that the attributes have allowed types and are equally long.
void CheckInstancing(const tinygltf::Model& model, Faults& faults);

/// The number of instances of the node's mesh: the length of its attributes, or 1 without the
/// extension. No data is read for it.
size_t InstanceCount(const tinygltf::Model& model, const tinygltf::Node& node);

}  // namespace fenestra::gltf
