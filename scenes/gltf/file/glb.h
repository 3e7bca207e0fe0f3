#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace fenestra::gltf {

/// The chunks of a binary glTF file; views into its bytes.
struct GlbChunks {
  std::string_view json;
  std::optional<std::span<const uint8_t>> binary;
};

/// Takes a .glb container apart (glTF 2.0 specification, chapter 4). Chunks of unknown type and
/// bytes behind the stated length are skipped, as the specification has it. Throws InputError.
GlbChunks SplitGlb(const std::filesystem::path& file, std::span<const uint8_t> bytes);

}  // namespace fenestra::gltf
