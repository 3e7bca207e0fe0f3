#include "scenes/gltf/file/glb.h"

#include <fmt/format.h>

#include <cstring>

#include "core/io/input_error.h"
#include "scenes/gltf/file/bytes.h"

namespace fenestra::gltf {
namespace {

constexpr size_t kHeaderBytes = 12;
constexpr size_t kChunkHeaderBytes = 8;
constexpr uint32_t kJsonChunk = 0x4E4F534A;
constexpr uint32_t kBinaryChunk = 0x004E4942;

struct Chunk {
  uint32_t type;
  std::span<const uint8_t> data;
};

size_t StatedLength(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
  if (bytes.size() < 4 || std::memcmp(bytes.data(), "glTF", 4) != 0) {
    throw InputError(file, "does not begin with 'glTF', as binary glTF does");
  }
  if (bytes.size() < kHeaderBytes) throw InputError(file, "ends within the header");
  const auto version = LoadLittleEndian<uint32_t>(&bytes[4]);
  if (version != 2) {
    throw InputError(file, fmt::format("binary glTF of version {}; version 2 is read", version));
  }
  const auto length = LoadLittleEndian<uint32_t>(&bytes[8]);
  if (length > bytes.size()) {
    throw InputError(file, fmt::format("cut off: {} of {} bytes are there", bytes.size(), length));
  }
  if (length < kHeaderBytes + kChunkHeaderBytes) {
    throw InputError(file, fmt::format("a length of {} bytes has no room for a chunk", length));
  }
  return length;
}

Chunk ChunkAt(const std::filesystem::path& file, std::span<const uint8_t> bytes, size_t at) {
  if (bytes.size() - at < kChunkHeaderBytes) {
    throw InputError(file, fmt::format("ends within the header of the chunk at byte {}", at));
  }
  const auto length = LoadLittleEndian<uint32_t>(&bytes[at]);
  const auto type = LoadLittleEndian<uint32_t>(&bytes[at + 4]);
  const size_t begin = at + kChunkHeaderBytes;
  if (length > bytes.size() - begin) {
    throw InputError(file, fmt::format("the chunk at byte {} claims {} bytes; {} are left", at,
                                       length, bytes.size() - begin));
  }
  if (length % 4 != 0) {
    throw InputError(
        file, fmt::format("the chunk at byte {} has {} bytes, not a multiple of 4", at, length));
  }
  return {type, bytes.subspan(begin, length)};
}

}  // namespace

GlbChunks SplitGlb(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
  bytes = bytes.first(StatedLength(file, bytes));
  GlbChunks chunks;
  int index = 0;
  for (size_t at = kHeaderBytes; at < bytes.size(); ++index) {
    const Chunk chunk = ChunkAt(file, bytes, at);
    at += kChunkHeaderBytes + chunk.data.size();
    if (index == 0) {
      if (chunk.type != kJsonChunk) throw InputError(file, "the first chunk is not JSON");
      if (chunk.data.empty()) throw InputError(file, "the JSON chunk is empty");
      chunks.json = {reinterpret_cast<const char*>(chunk.data.data()), chunk.data.size()};
    } else if (chunk.type == kJsonChunk) {
      throw InputError(file, "has more than one JSON chunk");
    } else if (chunk.type == kBinaryChunk) {
      if (chunks.binary) throw InputError(file, "has more than one binary chunk");
      if (index != 1) throw InputError(file, "the binary chunk is not the second one");
      chunks.binary = chunk.data;
    }
  }
  return chunks;
}

}  // namespace fenestra::gltf
