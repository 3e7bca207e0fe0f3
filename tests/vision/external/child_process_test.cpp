#include "vision/external/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>

namespace fenestra {
namespace {

std::atomic<int> signals = 0;

/// Counts what would end the process; SIGPIPE is let through to this thread meanwhile.
class CountedSigpipe {
 public:
  CountedSigpipe() {
    signals = 0;
    struct sigaction count {};
    count.sa_handler = [](int) { ++signals; };
    sigaction(SIGPIPE, &count, &before_);
    sigset_t pipe;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    pthread_sigmask(SIG_UNBLOCK, &pipe, &mask_before_);
  }
  ~CountedSigpipe() {
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
    sigaction(SIGPIPE, &before_, nullptr);
  }
  CountedSigpipe(const CountedSigpipe&) = delete;
  CountedSigpipe& operator=(const CountedSigpipe&) = delete;

 private:
  struct sigaction before_ {};
  sigset_t mask_before_{};
};

TEST(ChildProcess, WhoDoesNotListenRaisesNoSignal) {
  const CountedSigpipe sigpipe;
  // Has closed its standard input by the time that it answers, and lives on.
  ChildProcess deaf({"sh", "-c", "read line; exec <&-; echo answer; exec sleep 60"});
  const ChildProcess::Reply first = deaf.Exchange("one", 5.0);
  ASSERT_EQ(first.end, ChildProcess::End::kLine);
  EXPECT_EQ(first.line, "answer");
  EXPECT_EQ(deaf.Exchange("two", 5.0).end, ChildProcess::End::kClosed);
  EXPECT_EQ(signals, 0);
  // One that is meant for this process still arrives.
  raise(SIGPIPE);
  EXPECT_EQ(signals, 1);
}

}  // namespace
}  // namespace fenestra
