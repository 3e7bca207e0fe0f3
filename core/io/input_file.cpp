#include "core/io/input_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <iterator>

#include "core/io/input_error.h"
#include "core/io/system_error.h"

namespace fenestra {

namespace fs = std::filesystem;

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
  if (stream.bad() || bytes.size() != size) ThrowSystemFault(file, "cannot be read", errno);
  return bytes;
}

}  // namespace fenestra
