#pragma once

#include <filesystem>

namespace fenestra {

/// A new folder that only this user can enter, in memory (/dev/shm) where there is such a place,
/// else among the temporary files; removed with all its contents at the end of the scope. What
/// processes that were killed have left is removed when the next one is made. Throws InputError if
/// no folder can be made.
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
