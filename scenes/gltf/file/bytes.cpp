#include "scenes/gltf/file/bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/io/input_error.h"
#include "core/io/input_file.h"

namespace fenestra::gltf {
namespace {

constexpr size_t kLongestPath = 1024;

std::array<int, 256> Base64Values() {
  std::array<int, 256> values;
  values.fill(-1);
  constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < kAlphabet.size(); ++i) {
    values[static_cast<uint8_t>(kAlphabet[i])] = static_cast<int>(i);
  }
  return values;
}

// RFC 4648 with padding.
Bytes DecodeBase64(std::string_view text) {
  static const std::array<int, 256> kValues = Base64Values();
  if (text.size() % 4 != 0) throw std::invalid_argument("its base64 text is cut off");
  size_t padding = 0;
  while (padding < 2 && text.ends_with('=')) {
    text.remove_suffix(1);
    ++padding;
  }
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const int value = kValues[static_cast<uint8_t>(c)];
    if (value < 0)
      throw std::invalid_argument("its base64 text has characters that are not base64");
    bits = (bits << 6) | static_cast<uint32_t>(value);
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    bytes.push_back(static_cast<uint8_t>(bits >> bit_count));
  }
  return bytes;
}

// data:[type][;parameters];base64,...
Bytes DecodeDataUri(std::string_view uri, ByteBudget& budget) {
  const size_t comma = uri.find(',');
  if (comma == uri.npos) throw std::invalid_argument("a data URI without a comma");
  if (!uri.substr(0, comma).ends_with(";base64")) {
    throw std::invalid_argument("a data URI that is not base64");
  }
  const std::string_view text = uri.substr(comma + 1);
  if (!budget.Take(text.size() / 4 * 3)) {
    throw std::invalid_argument("more data than is read for one scene");
  }
  return DecodeBase64(text);
}

int HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  throw std::invalid_argument("a '%' without two hexadecimal digits");
}

std::string DecodePercent(std::string_view uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    if (i + 2 >= uri.size()) throw std::invalid_argument("a '%' without two hexadecimal digits");
    text += static_cast<char>(16 * HexDigit(uri[i + 1]) + HexDigit(uri[i + 2]));
    i += 2;
  }
  return text;
}

// RFC 3986: in a relative path no colon stands before the first slash, so there it ends a scheme.
bool HasScheme(std::string_view uri) {
  return uri.substr(0, uri.find('/')).find(':') != uri.npos;
}

bool IsInside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [in_folder, in_file] = std::ranges::mismatch(folder, file);
  return in_folder == folder.end() && in_file != file.end();
}

std::filesystem::path FileInFolder(std::string_view uri, const std::filesystem::path& folder) {
  if (uri.empty()) throw std::invalid_argument("an empty URI");
  const std::string name = DecodePercent(uri);
  if (name.find('\0') != name.npos) throw std::invalid_argument("a URI with a zero byte");
  if (HasScheme(uri)) {
    throw std::invalid_argument("only data URIs and relative paths are read");
  }
  if (name.starts_with('/') || name.find('\\') != name.npos) {
    throw std::invalid_argument("only relative paths with forward slashes are read");
  }
  if (name.size() > kLongestPath) throw std::invalid_argument("the path is too long");
  std::error_code error;
  const auto real_folder = std::filesystem::weakly_canonical(
      folder.empty() ? std::filesystem::path(".") : folder, error);
  if (error) throw std::invalid_argument("the file's folder cannot be resolved");
  auto real_file = std::filesystem::weakly_canonical(real_folder / name, error);
  if (error) throw std::invalid_argument("the path cannot be resolved");
  if (!IsInside(real_file, real_folder)) {
    throw std::invalid_argument("leaves the folder of the glTF file");
  }
  return real_file;
}

}  // namespace

Bytes ReadWholeFile(const std::filesystem::path& file, ByteBudget& budget) {
  std::ifstream stream = OpenInput(file);
  std::error_code error;
  const uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(file, "cannot be read: " + error.message());
  if (size > budget.limit() || !budget.Take(size)) {
    throw InputError(
        file, fmt::format("{} bytes; at most {} are read for one scene", size, budget.limit()));
  }
  Bytes bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) throw InputError(file, "cannot be read");
  return bytes;
}

Bytes ReadUri(std::string_view uri, const std::filesystem::path& folder, ByteBudget& budget) {
  if (uri.starts_with("data:")) return DecodeDataUri(uri, budget);
  return ReadWholeFile(FileInFolder(uri, folder), budget);
}

}  // namespace fenestra::gltf
