#include "experiments/store/lock_wait.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <sstream>
#include <thread>
#include <utility>

namespace fenestra {
namespace {

constexpr std::chrono::milliseconds kPause(50);

LockPatience& Patience() {
  static LockPatience patience;
  return patience;
}

// SQLite calls this with the number of earlier calls for the same lock, until it returns 0.
int OnBusy(void* database, int calls) {
  const LockPatience& patience = Patience();
  const auto waited = calls * kPause;
  if (waited >= patience.longest) return 0;
  if (waited >= patience.notice_after && waited < patience.notice_after + kPause) {
    const std::filesystem::path file = sqlite3_db_filename(static_cast<sqlite3*>(database), "main");
    patience.notice(fmt::format("{}: is locked by {}; waiting until it is closed there",
                                file.string(), LockHolders(file)));
  }
  std::this_thread::sleep_for(kPause);
  return 1;
}

std::string NameOf(pid_t process) {
  std::string name;
  std::ifstream stream(fmt::format("/proc/{}/comm", process));
  return std::getline(stream, name) ? name : "a program";
}

}  // namespace

void SetLockPatience(LockPatience patience) {
  Patience() = std::move(patience);
}

void WaitForLocks(sqlite3* database) {
  sqlite3_busy_handler(database, OnBusy, database);
}

std::string LockHolders(const std::filesystem::path& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) != 0) return "another program";
  const std::string place =
      fmt::format("{:02x}:{:02x}:{}", major(info.st_dev), minor(info.st_dev), info.st_ino);
  std::set<std::string> holders;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advisory, access, where;
    pid_t process = 0;
    words >> number >> kind >> advisory >> access >> process >> where;
    // Locks of other containers have process number 0 or -1; waiting ones are marked "->".
    if (!words || where != place || process <= 0 || process == getpid()) continue;
    holders.insert(fmt::format("{} (process {})", NameOf(process), process));
  }
  if (holders.empty()) return "another program";
  return fmt::format("{}", fmt::join(holders, ", "));
}

}  // namespace fenestra
