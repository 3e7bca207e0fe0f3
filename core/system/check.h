#pragma once

#include <stdexcept>
#include <string>

namespace fenestra {

/// Throws std::logic_error("file:line: check failed: condition (detail)").
[[noreturn]] inline void FailCheck(const char* file, int line, const char* condition,
                                   const std::string& detail) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) +
                         ": check failed: " + condition + " (" + detail + ")");
}

}  // namespace fenestra

/// An always-on check of an invariant: a failure is a fault of this program, never of its input
/// (that is an InputError).
#define FENESTRA_CHECK(condition, detail)                              \
  do {                                                                 \
    if (!(condition)) {                                                \
      ::fenestra::FailCheck(__FILE__, __LINE__, #condition, (detail)); \
    }                                                                  \
  } while (false)
