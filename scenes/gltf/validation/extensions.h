#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/faults.h"

namespace fenestra::gltf {

/// Whether Fenestra understands the extension, so that a file may require it.
bool IsSupported(std::string_view extension);

/// The names in the document's `extensionsUsed`.
std::set<std::string> DeclaredExtensions(const nlohmann::json& root);

/// The version, and that all required extensions are supported and declared.
void CheckVersionAndExtensions(const nlohmann::json& root, Faults& faults);

/// Extensions that the document uses and Fenestra leaves out.
std::vector<std::string> IgnoredExtensions(const nlohmann::json& root);

}  // namespace fenestra::gltf
