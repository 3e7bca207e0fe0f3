#pragma once

#include <nlohmann/json.hpp>

#include "core/io/faults.h"

namespace fenestra::gltf {

/// Holds the whole document against the schema: types, ranges, required members, references into
/// arrays, and extensions that are misplaced or not declared.
void CheckSchema(const nlohmann::json& root, Faults& faults);

}  // namespace fenestra::gltf
