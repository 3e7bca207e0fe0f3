#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

namespace fenestra {

/// The start of what a program wrote, for people: at most `most` bytes, '?' for all but printable
/// ASCII.
std::string Printable(std::string_view text, size_t most);

/// A child process that communicates in lines. Its standard input and output are pipes, and the end
/// of its standard error is kept. It leads a process group of its own, which is killed with it.
/// Nothing that it does can block, end or exhaust this process: every wait has a limit, writing to
/// a pipe that nobody reads raises no signal here, and its output is truncated.
class ChildProcess {
 public:
  /// Throws InputError if there is no such program or it is none, SystemError if the machine has no
  /// pipe or process left.
  explicit ChildProcess(const std::vector<std::string>& words);
  /// Closes its standard input, gives it a second to exit by itself, then kills its group.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  enum class End {
    kLine,     ///< It sent a line.
    kClosed,   ///< It exited or closed its standard output.
    kTimeout,  ///< The time limit was reached.
    kFlood,    ///< It wrote more than kMostBytes without a line's end, several lines, or too much
               ///< on standard error.
  };
  struct Reply {
    End end;
    std::string line;  ///< Without the line's end.
  };
  static constexpr size_t kMostBytes = 1u << 20;  ///< Longest line.
  static constexpr size_t kMostErrorBytes =
      16u << 20;  ///< Most output on standard error during one exchange.

  /// Writes one line and waits for one. Earlier output of the program is discarded. After any
  /// result but kLine the program can no longer be used.
  Reply Exchange(std::string_view line, double limit_s);

  /// How long to wait for a program that has been told to end.
  static constexpr double kGrace_s = 1.0;
  /// Closes its standard input, waits for it to exit, then kills its group. Returns how it ended,
  /// for people: "it ended with exit code 3", "it was ended by signal 11 (Segmentation fault)", "it
  /// was still running".
  std::string Stop(double grace_s = kGrace_s);
  /// Returns the last line that it wrote on standard error, at most 300 bytes; empty if there is
  /// none.
  std::string LastError() const;

 private:
  enum class Stream { kOpen, kDry, kEnded };

  /// Appends the available data to `text`.
  static Stream ReadSome(int file, std::string& text, size_t most);
  void ReadErrors();
  bool WriteSome(std::string_view& rest);
  void ForgetOutput();

  pid_t process_ = -1;
  int watch_ = -1;  ///< Readable when the process has ended (pidfd).
  int input_ = -1;
  int output_ = -1;
  int error_ = -1;
  std::string heard_;        ///< Standard output that has not been consumed yet.
  std::string last_errors_;  ///< The end of standard error.
  size_t error_bytes_ = 0;   ///< Bytes on standard error in this exchange.
};

}  // namespace fenestra
