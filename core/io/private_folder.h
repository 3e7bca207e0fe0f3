#pragma once

#include <filesystem>

namespace fenestra {

/// A new folder that only this user can enter, removed with its contents at the end of the scope.
/// It is in memory (/dev/shm) if possible, otherwise among the temporary files. Folders that killed
/// processes have left behind are removed when the next one is made. Throws InputError if no folder
/// can be made.
class PrivateFolder {
 public:
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace fenestra
