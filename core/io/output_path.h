#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace fenestra {

/// Where a file of the program goes.
///
/// A path that a user named is written as it is. Below a folder that was opened with Folder()
/// nothing is replaced or removed but what the program wrote there and nobody has changed since.
/// What it wrote is recorded in the folder's file kRecord, a line "<SHA-256>  <path below>" for
/// each file and version, before the file appears: so a process that is killed leaves nothing that
/// the next one takes for somebody else's. Copies share their record; all members are thread-safe,
/// and processes may write into one folder side by side.
class OutputPath {
 public:
  static constexpr char kRecord[] = ".fenestra";

  /// Implicit: every path is a place for a file.
  OutputPath(std::filesystem::path path) : path_(std::move(path)) {}
  static OutputPath Folder(std::filesystem::path folder);

  const std::filesystem::path& path() const { return path_; }
  OutputPath operator/(const std::filesystem::path& name) const;

  /// Throws InputError if one of these files below this folder is there and not the program's own;
  /// names them all.
  void RequireFree(const std::vector<std::string>& names) const;
  /// Throws InputError if it can be foreseen that nothing can be written here (a file to be) or below
  /// here (a folder): before work is done whose last step would fail. Changes nothing.
  void RequireWritable() const;
  /// Records that a file with this SHA-256 is about to appear here. Throws InputError if something
  /// else is there.
  void Claim(const std::string& sha256) const;
  /// Records the files as they are for the program's own. For folders of versions without a record.
  void Adopt(const std::vector<std::string>& names) const;
  /// Whether what is written here is recorded, and whether anything has been.
  bool IsRecorded() const { return record_ != nullptr; }
  bool HasRecord() const;
  /// Makes the record, if there is none: what appears in the folder from now on without being
  /// recorded is somebody else's.
  void StartRecord() const;

  /// Removes the program's own files of these names below this folder, all that are in a folder of
  /// such a name, and folders that are empty then.
  void RemoveOwn(const std::vector<std::string>& names) const;

 private:
  class Record;

  std::filesystem::path path_;
  std::shared_ptr<Record> record_;  // None for a path that a user named.
};

}  // namespace fenestra
