#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace fenestra::gltf {

using Bytes = std::vector<uint8_t>;

/// A number of a glTF file: little-endian and at any address. The caller has checked the bounds.
template <typename T>
T LoadLittleEndian(const uint8_t* at) {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

/// The number of bytes that may still be read, shared by all files of an asset: one small file can
/// refer to a large one many times.
class ByteBudget {
 public:
  explicit ByteBudget(size_t bytes) : limit_(bytes), left_(bytes) {}

  /// False if there are not that many left.
  [[nodiscard]] bool Take(size_t bytes) {
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }
  size_t limit() const { return limit_; }

 private:
  size_t limit_;
  size_t left_;
};

/// The whole of a regular file. Throws InputError for any other file, one that cannot be read and
/// one beyond the budget.
Bytes ReadWholeFile(const std::filesystem::path& file, ByteBudget& budget);

/// Reads the data that a URI in a glTF file refers to: data inside the URI itself, or a file in the
/// folder of the glTF file or below it. Nothing else is ever opened: no other scheme, no absolute
/// path, and no file that ".." or a symbolic link leads to. Throws std::invalid_argument with the
/// reason, or InputError where the file itself cannot be read.
Bytes ReadUri(std::string_view uri, const std::filesystem::path& folder, ByteBudget& budget);

}  // namespace fenestra::gltf
