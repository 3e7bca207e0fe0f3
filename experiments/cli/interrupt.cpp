#include "experiments/cli/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <string_view>

namespace fenestra::cli {
namespace {

// A signal handler has no other way to tell.
std::atomic<bool> requested_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void Handle(int) {
  requested_flag = true;
  constexpr std::string_view kNote =
      "\nfenestra: ending with the trials that run; once more to end at once\n";
  const ssize_t written = write(STDERR_FILENO, kNote.data(), kNote.size());
  static_cast<void>(written);  // There is nobody to tell.
}

}  // namespace

InterruptWatch::InterruptWatch() {
  requested_flag = false;
  struct sigaction action {};
  action.sa_handler = Handle;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGTERM, &action, &old_terminate_);
}

InterruptWatch::~InterruptWatch() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
}

bool InterruptWatch::requested() const {
  return requested_flag;
}

}  // namespace fenestra::cli
