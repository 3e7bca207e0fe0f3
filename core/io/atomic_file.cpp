#include "core/io/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <fstream>

#include "core/io/input_error.h"

namespace fenestra {

std::filesystem::path TemporaryBeside(const std::filesystem::path& file) {
  static std::atomic<unsigned> serial = 0;  // Two threads may write to one folder.
  std::filesystem::path temporary = file;
  temporary += ".tmp" + std::to_string(getpid()) + "-" + std::to_string(serial++);
  return temporary;
}

void WriteFileAtomically(const std::filesystem::path& file, std::string_view bytes) {
  WriteFileAtomically(file, [bytes](std::ostream& stream) {
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

void WriteFileAtomically(const std::filesystem::path& file,
                         const std::function<void(std::ostream&)>& write) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  if (error) throw InputError(file, "its folder cannot be made: " + error.message());
  const std::filesystem::path temporary = TemporaryBeside(file);
  {
    std::ofstream stream(temporary, std::ios::binary);
    try {
      write(stream);
    } catch (...) {
      std::filesystem::remove(temporary, error);
      throw;
    }
    stream.close();
    if (!stream) {
      std::filesystem::remove(temporary, error);
      throw InputError(file, "cannot be written");
    }
  }
  std::filesystem::rename(temporary, file, error);
  if (error) {
    const std::string reason = error.message();
    std::filesystem::remove(temporary, error);
    throw InputError(file, "cannot be written: " + reason);
  }
}

}  // namespace fenestra
