#pragma once

#include <nlohmann/json.hpp>

#include "scenes/gltf/fault_list.h"

namespace fenestra::gltf {

/// Holds the whole document against the schema: types, ranges, required members, references into
/// arrays, and extensions that are misplaced or not declared.
void CheckSchema(const nlohmann::json& root, FaultList& faults);

}  // namespace fenestra::gltf
