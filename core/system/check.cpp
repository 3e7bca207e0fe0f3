#include "core/system/check.h"

#include <fmt/format.h>

#include <stdexcept>

namespace fenestra {

void FailCheck(const char* file, int line, const char* condition, const std::string& detail) {
  throw std::logic_error(
      fmt::format("{}:{}: check failed: {} ({})", file, line, condition, detail));
}

}  // namespace fenestra
