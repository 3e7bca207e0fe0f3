#include "core/io/temporary_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "core/io/sha256.h"
#include "core/io/system_error.h"

namespace fenestra {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "fenestra-private-";
constexpr std::string_view kPattern = "XXXXXX";  // What mkdtemp replaces.

// Room for the pictures of many jobs. Where memory is short, a disk serves as well.
constexpr uintmax_t kEnoughMemory_bytes = 16u << 20;

fs::path Parent() {
  const fs::path memory = "/dev/shm";
  std::error_code error;
  const fs::space_info space = fs::space(memory, error);
  if (!error && space.available >= kEnoughMemory_bytes &&
      access(memory.c_str(), W_OK | X_OK) == 0) {
    return memory;
  }
  const fs::path disk = fs::temp_directory_path(error);
  if (error) {
    throw SystemError(fmt::format(
        "no folder for temporary files: {} is full or cannot be written, and TMPDIR names {}",
        memory.string(),
        std::getenv("TMPDIR") == nullptr ? "none, nor is there /tmp" : "no folder"));
  }
  return fs::absolute(disk);
}

bool IsSame(int descriptor, const fs::path& folder) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && lstat(folder.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

int OpenFolder(const fs::path& folder) {
  return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

// Removes a folder of this user that no process has locked. One that cannot be locked (NFS) stays.
void RemoveIfLeftBehind(const fs::path& folder) {
  const int descriptor = OpenFolder(folder);
  if (descriptor < 0) return;
  struct stat info {};
  if (fstat(descriptor, &info) == 0 && info.st_uid == getuid() &&
      flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    std::error_code error;
    fs::remove_all(folder, error);
  }
  close(descriptor);
}

void RemoveWhatWasLeft(const fs::path& parent) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(parent, error)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(kPrefix) && name.size() == kPrefix.size() + kPattern.size()) {
      RemoveIfLeftBehind(entry.path());
    }
  }
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
  if (error) ThrowSystemFault(path, "its folder cannot be made", error.value());
  const fs::path temporary = TemporaryBeside(path);
  {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary);
    try {
      if (stream) write(stream);
      stream.close();
      if (!stream) ThrowSystemFault(path, "cannot be written", errno);
      if (file.IsRecorded()) file.Claim(Sha256OfFile(temporary));
    } catch (...) {
      fs::remove(temporary, error);
      throw;
    }
  }
  fs::rename(temporary, path, error);
  if (error) {
    const int reason = error.value();
    fs::remove(temporary, error);
    ThrowSystemFault(path, "cannot be written", reason);
  }
}

PrivateFolder::PrivateFolder() {
  const fs::path parent = Parent();
  RemoveWhatWasLeft(parent);
  do {  // Another process may take it for left behind before it is locked.
    if (descriptor_ >= 0) close(descriptor_);
    std::string pattern = (parent / fmt::format("{}{}", kPrefix, kPattern)).string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw SystemError(parent, fmt::format("no folder can be made there: {}", strerror(errno)));
    }
    path_ = pattern;
    descriptor_ = OpenFolder(path_);
    while (descriptor_ >= 0 && flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
  } while (descriptor_ < 0 ? errno == ENOENT : !IsSame(descriptor_, path_));
  if (descriptor_ < 0) throw SystemError(path_, strerror(errno));
}

PrivateFolder::~PrivateFolder() {
  std::error_code error;
  if (IsSame(descriptor_, path_)) fs::remove_all(path_, error);
  close(descriptor_);
}

void PrivateFolder::RequireThere() const {
  if (!IsSame(descriptor_, path_)) throw SystemError(path_, "was removed by another program");
}

}  // namespace fenestra
