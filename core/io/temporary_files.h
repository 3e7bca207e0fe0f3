#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string_view>

#include "core/io/output_path.h"

namespace fenestra {

/// A name beside `file` that no other process and no other thread uses, for what becomes `file`
/// when it is complete.
std::filesystem::path TemporaryBeside(const std::filesystem::path& file);

/// Writes `bytes` to a temporary file in the same folder, which is made if it is missing, and
/// renames it to `file`: readers see the old file or the whole new one. Throws InputError.
void WriteFileAtomically(const OutputPath& file, std::string_view bytes);

/// Writes a file that is too large for memory in the same way: `write` puts it into the stream. If
/// `write` throws, nothing is left behind.
void WriteFileAtomically(const OutputPath& file, const std::function<void(std::ostream&)>& write);

/// A new folder that only this user can enter, removed with its contents at the end of the scope.
/// It is in memory (/dev/shm) if there is room, otherwise among the temporary files. Its process
/// holds a lock on it, so that folders that killed processes have left behind, and no others, are
/// removed when the next one is made: a process number would mean nothing where containers share the
/// place. Throws SystemError if no folder can be made.
class PrivateFolder {
 public:
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Throws SystemError if it is no longer there: others may clear the place, too.
  void RequireThere() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;  ///< Locked as long as the folder is in use.
};

}  // namespace fenestra
