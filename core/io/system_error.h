#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace fenestra {

/// The machine failed: a full disk, too many open files, no further process. Neither the input nor
/// a detector is to blame, and the same command may succeed later.
class SystemError : public std::runtime_error {
 public:
  explicit SystemError(const std::string& message) : std::runtime_error(message) {}
  SystemError(const std::filesystem::path& source, const std::string& message)
      : SystemError(source.string() + ": " + message) {}
};

/// Whether the system refuses, by `error_number` (errno), for a reason that lies in the path that
/// it was given: missing, forbidden, not a folder, mounted for reading only.
bool IsFaultOfPath(int error_number);

/// Throws "place: what: the system's reason", an InputError where IsFaultOfPath and a SystemError
/// otherwise. The reason of number 0 is unknown and left out.
[[noreturn]] void ThrowSystemFault(const std::filesystem::path& place, const std::string& what,
                                   int error_number);

}  // namespace fenestra
