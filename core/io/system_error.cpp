#include "core/io/system_error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "core/io/input_error.h"

namespace fenestra {

bool IsFaultOfPath(int error_number) {
  constexpr std::array kOfPath = {EACCES,       EBUSY,  EEXIST, EINVAL,  EISDIR,  ELOOP,
                                  ENAMETOOLONG, ENODEV, ENOENT, ENOEXEC, ENOTDIR, ENOTEMPTY,
                                  ENXIO,        EPERM,  EROFS,  ETXTBSY, EXDEV};
  return std::find(kOfPath.begin(), kOfPath.end(), error_number) != kOfPath.end();
}

void ThrowSystemFault(const std::filesystem::path& place, const std::string& what,
                      int error_number) {
  std::string message = what;
  if (error_number != 0) message += ": " + std::generic_category().message(error_number);
  if (IsFaultOfPath(error_number)) throw InputError(place, message);
  throw SystemError(place, message);
}

}  // namespace fenestra
