#include "core/io/temporary_files.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "core/io/input_error.h"
#include "core/io/sha256.h"

namespace fenestra {

namespace fs = std::filesystem;

namespace {

// The number of the process follows, so that others can tell which folders are abandoned.
constexpr std::string_view kPrefix = "fenestra-";

fs::path Parent() {
  const char* const memory = "/dev/shm";
  return access(memory, W_OK | X_OK) == 0 ? fs::path(memory) : fs::temp_directory_path();
}

bool IsLeftBehind(const fs::path& folder) {
  const std::string name = folder.filename();
  if (!name.starts_with(kPrefix)) return false;
  pid_t pid = 0;
  const char* const end = name.data() + name.size();
  const auto [dash, error] = std::from_chars(name.data() + kPrefix.size(), end, pid);
  if (error != std::errc() || dash == end || *dash != '-' || pid <= 0) return false;
  struct stat info {};
  if (lstat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode)) return false;
  return info.st_uid == getuid() && kill(pid, 0) != 0 && errno == ESRCH;
}

void RemoveWhatWasLeft(const fs::path& parent) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(parent, error)) {
    if (IsLeftBehind(entry.path())) fs::remove_all(entry.path(), error);
  }
}

// With the system's reason: the streams of the library keep none but errno.
std::string CannotBeWritten() {
  return errno == 0 ? "cannot be written"
                    : fmt::format("cannot be written: {}", std::strerror(errno));
}

}  // namespace

std::filesystem::path TemporaryBeside(const std::filesystem::path& file) {
  static std::atomic<unsigned> serial = 0;  // Two threads may write to one folder.
  std::filesystem::path temporary = file;
  temporary += ".tmp" + std::to_string(getpid()) + "-" + std::to_string(serial++);
  return temporary;
}

void WriteFileAtomically(const OutputPath& file, std::string_view bytes) {
  WriteFileAtomically(file, [bytes](std::ostream& stream) {
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

void WriteFileAtomically(const OutputPath& file, const std::function<void(std::ostream&)>& write) {
  const fs::path& path = file.path();
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) throw InputError(path, "its folder cannot be made: " + error.message());
  const fs::path temporary = TemporaryBeside(path);
  {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary);
    try {
      if (stream) write(stream);
      stream.close();
      if (!stream) throw InputError(path, CannotBeWritten());
      if (file.IsRecorded()) file.Claim(Sha256OfFile(temporary));
    } catch (...) {
      fs::remove(temporary, error);
      throw;
    }
  }
  fs::rename(temporary, path, error);
  if (error) {
    const std::string reason = error.message();
    fs::remove(temporary, error);
    throw InputError(path, "cannot be written: " + reason);
  }
}

PrivateFolder::PrivateFolder() {
  const fs::path parent = Parent();
  RemoveWhatWasLeft(parent);
  std::string pattern = (parent / fmt::format("{}{}-XXXXXX", kPrefix, getpid())).string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw InputError(parent, fmt::format("no folder can be made there: {}", strerror(errno)));
  }
  path_ = pattern;
}

PrivateFolder::~PrivateFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

}  // namespace fenestra
