#include "core/io/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <iterator>

#include "core/io/input_error.h"
#include "core/io/system_error.h"

namespace fenestra {

namespace fs = std::filesystem;

namespace {

// Bytes of the character at the beginning of `text`, which is not empty; 0 if it is none.
size_t CharacterLength(std::string_view text) {
  const auto byte = [text](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || length > text.size()) return 0;
  uint32_t code = first & (0x7fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = (code << 6) | (byte(i) & 0x3fu);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return overlong || surrogate || code > 0x10ffff ? 0 : length;
}

}  // namespace

std::ifstream OpenInput(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw InputError(file, "no such file");
  if (error) ThrowSystemFault(file, "cannot be read", error.value());
  if (!fs::is_regular_file(status)) throw InputError(file, "not a regular file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) ThrowSystemFault(file, "cannot be read", errno);
  return stream;
}

std::string ReadWholeFile(const fs::path& file, uintmax_t most_bytes) {
  std::ifstream stream = OpenInput(file);
  std::error_code error;
  const uintmax_t size = fs::file_size(file, error);
  if (error) ThrowSystemFault(file, "cannot be read", error.value());
  if (size > most_bytes) {
    throw InputError(file, fmt::format("{} bytes; at most {} are read", size, most_bytes));
  }
  errno = 0;
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (stream.bad()) ThrowSystemFault(file, "cannot be read", errno);
  if (bytes.size() != size) throw InputError(file, "changed while it was read");
  return bytes;
}

std::optional<size_t> FirstNotUtf8(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const size_t length = CharacterLength(text.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return std::nullopt;
}

std::string LowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool IsHidden(const std::filesystem::path& file) {
  return file.filename().string().starts_with('.');
}

}  // namespace fenestra
