#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "scenes/gltf/bytes.h"

namespace fenestra::gltf {

/// A glTF file taken out of its container: the JSON and, in a .glb, the binary chunk.
struct Document {
  std::filesystem::path file;
  nlohmann::json json;
  std::optional<Bytes> binary_chunk;
};

/// Reads .gltf or .glb. Throws InputError for a damaged container and for text that is not JSON,
/// with its line and column, or that is nested too deeply.
Document ReadDocument(const std::filesystem::path& file, ByteBudget& budget);

}  // namespace fenestra::gltf
