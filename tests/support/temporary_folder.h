#pragma once

#include <filesystem>
#include <string>

namespace fenestra::testing {

/// A new empty folder that is removed with all its contents at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// Writes a file into the folder, or a new one below it, and returns its path.
  std::filesystem::path Write(const std::string& name, const std::string& text) const;
  bool IsEmpty() const { return std::filesystem::is_empty(path_); }

 private:
  std::filesystem::path path_;
};

/// The whole content of a file.
std::string ReadFile(const std::filesystem::path& file);

}  // namespace fenestra::testing
