#include "core/io/output_path.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <mutex>
#include <set>
#include <utility>

#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "core/io/sha256.h"
#include "core/io/system_error.h"
#include "core/system/check.h"

namespace fenestra {

namespace fs = std::filesystem;

namespace {

constexpr const char* kInTheWay =
    "was not written by this program or has been changed since, and is not replaced; move it away "
    "or choose another folder";

// The place itself, or all files and folders below it, folders after what is in them.
std::vector<fs::path> Below(const fs::path& place) {
  std::vector<fs::path> found{place};
  if (fs::is_directory(fs::symlink_status(place))) {
    for (const auto& entry : fs::recursive_directory_iterator(place)) found.push_back(entry.path());
  }
  std::reverse(found.begin(), found.end());
  return found;
}

}  // namespace

class OutputPath::Record {
 public:
  explicit Record(fs::path folder) : folder_(std::move(folder)), file_(folder_ / kRecord) {
    Read();
  }

  bool exists() const { return fs::exists(file_); }

  // Whether nothing is in this place, or a file as the program wrote it.
  bool IsFree(const fs::path& file) {
    const std::scoped_lock lock(mutex_);
    return IsFreeLocked(file);
  }

  void Claim(const fs::path& file, const std::string& sha256) {
    const std::scoped_lock lock(mutex_);
    if (!IsFreeLocked(file)) throw InputError(file, kInTheWay);
    Add(file, sha256);
  }

  void Start() {
    const std::scoped_lock lock(mutex_);
    Append("");
  }

  void Adopt(const fs::path& file) {
    const std::scoped_lock lock(mutex_);
    if (fs::is_regular_file(file)) Add(file, Sha256OfFile(file));
  }

 private:
  std::string NameOf(const fs::path& file) const { return file.lexically_relative(folder_); }

  bool IsFreeLocked(const fs::path& file) {
    const fs::file_status status = fs::symlink_status(file);
    if (!fs::exists(status)) return true;
    if (!fs::is_regular_file(status)) return false;
    const std::pair entry(NameOf(file), Sha256OfFile(file));
    if (written_.contains(entry)) return true;
    Read();  // Another process may have written it meanwhile.
    return written_.contains(entry);
  }

  void Add(const fs::path& file, const std::string& sha256) {
    if (!written_.emplace(NameOf(file), sha256).second) return;
    Append(fmt::format("{}  {}\n", sha256, NameOf(file)));
  }

  // In one write, so that lines of several processes do not mix.
  void Append(const std::string& lines) {
    std::error_code error;
    fs::create_directories(folder_, error);
    errno = 0;
    std::ofstream stream(file_, std::ios::app);
    stream << lines << std::flush;
    if (!stream) ThrowSystemFault(file_, "cannot be written", errno);
  }

  void Read() {
    constexpr size_t kDigits = 64;
    std::ifstream stream(file_);
    for (std::string line; std::getline(stream, line);) {
      if (line.size() <= kDigits + 2) continue;
      written_.emplace(line.substr(kDigits + 2), line.substr(0, kDigits));
    }
  }

  const fs::path folder_;
  const fs::path file_;
  std::mutex mutex_;
  std::set<std::pair<std::string, std::string>> written_;  // Name and SHA-256.
};

OutputPath OutputPath::Folder(fs::path folder) {
  OutputPath opened(folder);
  opened.record_ = std::make_shared<Record>(std::move(folder));
  return opened;
}

OutputPath OutputPath::operator/(const fs::path& name) const {
  OutputPath below(path_ / name);
  below.record_ = record_;
  return below;
}

void OutputPath::RequireFree(const std::vector<std::string>& names) const {
  if (!record_) return;
  Faults faults(path_);
  for (const std::string& name : names) {
    faults.Require(record_->IsFree(path_ / name), fmt::format("{} {}", name, kInTheWay));
  }
  faults.ThrowIfAny();
}

void OutputPath::RequireWritable() const {
  std::error_code error;
  if (!record_ && fs::is_directory(path_, error)) {
    throw InputError(path_, "cannot be written: it is a folder");
  }
  fs::path folder = record_ ? fs::absolute(path_) : fs::absolute(path_).parent_path();
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  if (!fs::is_directory(folder, error)) ThrowSystemFault(folder, "cannot be written", ENOTDIR);
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    ThrowSystemFault(folder, "cannot be written", errno);
  }
}

void OutputPath::Claim(const std::string& sha256) const {
  if (record_) record_->Claim(path_, sha256);
}

void OutputPath::Adopt(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    for (const fs::path& place : Below(path_ / name)) record_->Adopt(place);
  }
}

void OutputPath::StartRecord() const {
  record_->Start();
}

bool OutputPath::HasRecord() const {
  return record_ && record_->exists();
}

void OutputPath::RemoveOwn(const std::vector<std::string>& names) const {
  FENESTRA_CHECK(record_ != nullptr, "files of a path that a user named are not ours to remove");
  for (const std::string& name : names) {
    for (const fs::path& place : Below(path_ / name)) {
      std::error_code not_empty;
      const bool is_folder = fs::is_directory(fs::symlink_status(place));
      if (is_folder || record_->IsFree(place)) fs::remove(place, not_empty);
    }
  }
}

}  // namespace fenestra
