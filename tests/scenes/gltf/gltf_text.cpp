#include "tests/scenes/gltf/gltf_text.h"

#include <fmt/format.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/io/input_error.h"
#include "scenes/gltf/reader/gltf_reader.h"
#include "tests/support/temporary_folder.h"

namespace fenestra::testing {
namespace {

using nlohmann::json;

void Append32(std::string& bytes, uint32_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

json TriangleDocument() {
  json document = json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
       "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 1, "byteLength": 6}],
    "buffers": [{"byteLength": 36}, {"byteLength": 6}]})");
  document["buffers"][0]["uri"] = DataUriOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  document["buffers"][1]["uri"] = DataUriOf<uint16_t>({0, 1, 2});
  return document;
}

int AddAccessor(json& document, const std::string& type, const std::vector<float>& values) {
  const size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : size_t(type.back() - '0');
  const size_t bytes = values.size() * sizeof(float);
  document["buffers"].push_back({{"byteLength", bytes}, {"uri", DataUriOf(values)}});
  document["bufferViews"].push_back(
      {{"buffer", document["buffers"].size() - 1}, {"byteLength", bytes}});
  document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                   {"componentType", 5126},
                                   {"count", values.size() / components},
                                   {"type", type}});
  return static_cast<int>(document["accessors"].size()) - 1;
}

std::string DataUri(std::span<const uint8_t> bytes) {
  constexpr const char* kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = "data:application/octet-stream;base64,";
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) {
      uri += i + k <= bytes.size() ? kAlphabet[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return uri;
}

GltfScene ReadDocument(const json& document, const GltfReadOptions& options) {
  const TemporaryFolder folder;
  return ReadGltf(folder.Write("scene.gltf", document.dump()), options);
}

std::string Refusal(const json& document, const GltfReadOptions& options) {
  const TemporaryFolder folder;
  return Refusal(folder.Write("scene.gltf", document.dump()), options);
}

std::string Refusal(const std::filesystem::path& file, const GltfReadOptions& options) {
  try {
    ReadGltf(file, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string RefusalOfBytes(const std::string& bytes, const std::string& name) {
  const TemporaryFolder folder;
  return Refusal(folder.Write(name, bytes));
}

std::string Glb(const std::vector<std::pair<uint32_t, std::string>>& chunks) {
  std::string body;
  for (const auto& [type, data] : chunks) {
    const std::string padding((4 - data.size() % 4) % 4, type == kJsonChunk ? ' ' : '\0');
    Append32(body, static_cast<uint32_t>(data.size() + padding.size()));
    Append32(body, type);
    body += data + padding;
  }
  std::string file = "glTF";
  Append32(file, 2);
  Append32(file, static_cast<uint32_t>(12 + body.size()));
  return file + body;
}

std::vector<uint8_t> Png(int width_px, int height_px, std::array<uint8_t, 4> rgba) {
  const cv::Mat4b image(height_px, width_px, cv::Vec4b(rgba[2], rgba[1], rgba[0], rgba[3]));
  std::vector<uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  return bytes;
}

std::filesystem::path GltfData() {
  return std::filesystem::path(FENESTRA_SOURCE_DIR) / "tests/data/gltf";
}

double SignedVolume(const Mesh& mesh) {
  double volume = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions_W[t.x];
    const glm::dvec3 b = mesh.positions_W[t.y];
    const glm::dvec3 c = mesh.positions_W[t.z];
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return volume;
}

}  // namespace fenestra::testing
