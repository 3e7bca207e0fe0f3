#include "scenes/gltf/file/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "core/io/input_error.h"
#include "core/io/input_file.h"

namespace fenestra::gltf {
namespace {

using nlohmann::json;

// Deepest nesting that is read, since readers of JSON trees recurse. glTF 2.0 with our extensions
// needs about 10.
constexpr int kDeepestNesting = 64;
// A node without members, two values, takes a kilobyte. The largest honest scenes have some
// thousands.
constexpr size_t kMostValues = 1'500'000;

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

// The chunks of a binary glTF file; views into its bytes.
struct GlbChunks {
  std::string_view json;
  std::optional<std::span<const uint8_t>> binary;
};

// Takes a .glb container apart (glTF 2.0 specification, chapter 4). Chunks of unknown type and
// bytes behind the stated length are skipped, as the specification has it. Throws InputError.
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

[[noreturn]] void RefuseText(const std::filesystem::path& file, std::string_view text, size_t byte,
                             std::string message) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = static_cast<int>(std::ranges::count(before, '\n')) + 1;
  const size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0: the first line.
  const int column = std::max(1, static_cast<int>(before.size() - line_start));
  throw InputError(std::vector<InputFault>{{file.string(), line, column, std::move(message)}});
}

// nlohmann's message without its "[json.exception.parse_error.101] parse error at line 1, column 2:
// ".
std::string PlainReason(std::string_view what) {
  const size_t colon = what.find(": ");
  return "not JSON: " + std::string(colon == what.npos ? what : what.substr(colon + 2));
}

// Limits the cost of parsing the text by its brackets and commas outside of strings. Whether it is
// JSON is left to the parser. (The parser's own callback could do this, but takes time in
// proportion to the square of an array's length.)
void CheckCost(const std::filesystem::path& file, std::string_view text) {
  int depth = 0;
  size_t values = 1;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      ++depth;
      ++values;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',') {
      ++values;
    }
    if (depth > kDeepestNesting) {
      throw InputError(file, fmt::format("nested deeper than {} levels", kDeepestNesting));
    }
    if (values > kMostValues) {
      throw InputError(file, fmt::format("more than {} JSON values", kMostValues));
    }
  }
}

json ParseJson(const std::filesystem::path& file, std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) {
    throw InputError(file, "begins with a byte order mark, which glTF forbids");
  }
  CheckCost(file, text);
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::parse_error& error) {
    RefuseText(file, text, error.byte, PlainReason(error.what()));
  } catch (const json::exception& error) {  // A number that no double can hold.
    throw InputError(file, PlainReason(error.what()));
  }
}

}  // namespace

Document ReadDocument(const std::filesystem::path& file, ByteBudget& budget) {
  const Bytes bytes = ReadWholeFile(file, budget);
  Document document{.file = file, .json = {}, .binary_chunk = {}};
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  // The file's extension does not decide: a wrong one should not matter, and damaged magic bytes of
  // a .glb are reported as such.
  const bool is_binary = text.starts_with("glTF") || LowerExtension(file) == ".glb";
  if (is_binary) {
    const GlbChunks chunks = SplitGlb(file, bytes);
    text = chunks.json;
    if (chunks.binary) document.binary_chunk.emplace(chunks.binary->begin(), chunks.binary->end());
  }
  document.json = ParseJson(file, text);
  if (!document.json.is_object()) throw InputError(file, "the JSON is not an object");
  const json::json_pointer first("/buffers/0");
  if (is_binary && !document.binary_chunk && document.json.contains(first) &&
      !document.json[first].contains("uri")) {
    throw InputError(file, "/buffers/0: without a 'uri' it is the binary chunk, which is missing");
  }
  return document;
}

std::string MemberPointer(const std::string& name) {
  return (json::json_pointer() / name).to_string();
}

}  // namespace fenestra::gltf
