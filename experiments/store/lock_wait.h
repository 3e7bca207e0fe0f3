#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

struct sqlite3;

namespace fenestra {

/// How long stores wait for other programs that have them open: a reader that keeps its place (a
/// table that is left open in a viewer) holds up whoever writes.
struct LockPatience {
  std::chrono::milliseconds notice_after{5'000};
  /// Longer than any lunch: a run that waits can go on, one that has ended has lost its night.
  std::chrono::milliseconds longest = std::chrono::hours(12);
  /// Is told once for each wait that takes longer than `notice_after`, in a whole sentence that
  /// names the other program, from whatever thread waits.
  std::function<void(const std::string&)> notice = [](const std::string&) {};
};

/// Of all stores of this program; to be set before the first one is opened.
void SetLockPatience(LockPatience patience);

/// Makes a connection wait as the patience says.
void WaitForLocks(sqlite3* database);

/// The other programs of this machine that hold a lock on a file, for people: "sqlite3 (process
/// 71)"; "another program" if none can be named, as in another container. Source: proc(5),
/// /proc/locks.
std::string LockHolders(const std::filesystem::path& file);

}  // namespace fenestra
