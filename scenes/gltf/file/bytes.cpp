#include "scenes/gltf/file/bytes.h"

#include <fmt/format.h>

#include <fstream>

#include "core/io/input_error.h"

namespace fenestra::gltf {

Bytes ReadWholeFile(const std::filesystem::path& file, ByteBudget& budget) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError(file, "no such file");
  // A pipe or a device may never end.
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(file, "not a regular file");
  const uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(file, "cannot be read: " + error.message());
  if (size > budget.limit() || !budget.Take(size)) {
    throw InputError(
        file, fmt::format("{} bytes; at most {} are read for one scene", size, budget.limit()));
  }
  Bytes bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) throw InputError(file, "cannot be read");
  return bytes;
}

}  // namespace fenestra::gltf
