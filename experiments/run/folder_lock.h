#pragma once

#include <filesystem>

namespace fenestra {

/// Keeps two processes from running into the same results folder. Held while it lives; released by
/// the system if the process is killed. On file systems that cannot lock a folder it does nothing.
class FolderLock {
 public:
  /// Makes the folder if it is missing. Throws InputError if that fails or if another process holds
  /// the lock.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace fenestra
