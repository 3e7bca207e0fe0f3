#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "scenes/gltf/gltf.h"

namespace fenestra::testing {

/// A glTF document of one node with one triangle, (0, 0, 0), (1, 0, 0), (0, 1, 0), in buffer 0 as
/// accessor 0; accessor 1 has its indices as uint16. All tests with their own files start from it.
nlohmann::json TriangleDocument();

/// Appends an accessor with a buffer and a view of its own, and returns its index.
int AddAccessor(nlohmann::json& document, const std::string& type,
                const std::vector<float>& values);

std::string DataUri(std::span<const uint8_t> bytes);
template <typename T>
std::string DataUriOf(const std::vector<T>& values) {
  return DataUri({reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)});
}

/// Writes the document to a temporary file and reads it.
GltfScene ReadDocument(const nlohmann::json& document, const GltfReadOptions& options = {});

/// The message of the InputError that reading gives; "" where there is none.
std::string Refusal(const nlohmann::json& document, const GltfReadOptions& options = {});
std::string Refusal(const std::filesystem::path& file, const GltfReadOptions& options = {});
/// Of a file with these bytes and this name.
std::string RefusalOfBytes(const std::string& bytes, const std::string& name = "scene.gltf");

/// A binary glTF file of chunks, (type, data) each.
std::string Glb(const std::vector<std::pair<uint32_t, std::string>>& chunks);
inline constexpr uint32_t kJsonChunk = 0x4E4F534A;
inline constexpr uint32_t kBinaryChunk = 0x004E4942;

/// A PNG file of one colour.
std::vector<uint8_t> Png(int width_px, int height_px, std::array<uint8_t, 4> rgba);

/// tests/data/gltf.
std::filesystem::path GltfData();

/// Volume that the triangles enclose, positive where they wind counter-clockwise from outside.
double SignedVolume(const Mesh& mesh);

}  // namespace fenestra::testing
