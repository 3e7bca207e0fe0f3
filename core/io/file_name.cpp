#include "core/io/file_name.h"

#include <algorithm>
#include <cctype>

namespace fenestra {

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
