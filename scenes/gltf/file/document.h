#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "scenes/gltf/file/bytes.h"

namespace fenestra::gltf {

/// The most faults that are reported of one file.
inline constexpr size_t kMostFaults = 50;

/// A glTF file taken out of its container: the JSON and, in a .glb, the binary chunk.
struct Document {
  std::filesystem::path file;
  nlohmann::json json;
  std::optional<Bytes> binary_chunk;
};

/// Reads .gltf or .glb. Throws InputError for a damaged container and for text that is not JSON,
/// with its line and column, or that is nested too deeply.
Document ReadDocument(const std::filesystem::path& file, ByteBudget& budget);

/// The JSON pointer (RFC 6901) from an object to its member: "/" and the escaped name.
std::string MemberPointer(const std::string& name);

}  // namespace fenestra::gltf
