#pragma once

#include <csignal>

namespace fenestra::cli {

/// While it lives, the first SIGINT (Ctrl-C) or SIGTERM asks the program to come to an end, and the
/// second one of its kind ends it at once, as if this were not there. At most one at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// Whether a signal came. Thread-safe.
  bool requested() const;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

}  // namespace fenestra::cli
