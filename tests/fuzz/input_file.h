#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace fenestra {

/// Writes libFuzzer's bytes to this process's own file and returns its path. `extension` with its
/// dot.
inline std::filesystem::path InputFile(const uint8_t* data, size_t size,
                                       const std::string& extension) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("fenestra-fuzz-" + std::to_string(getpid()) + extension);
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return file;
}

}  // namespace fenestra
