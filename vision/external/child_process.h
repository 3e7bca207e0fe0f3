#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

namespace fenestra {

/// A program that runs beside this one and talks in lines: standard input and output are pipes, of
/// standard error the end is kept. It leads a process group of its own, which dies with it. Nothing
/// that it does can block, end or exhaust this process: every wait has a limit, a pipe that nobody
/// reads raises no signal here, and what it says is cut.
class ChildProcess {
 public:
  /// Throws InputError if there is no such program or it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& words);
  /// Closes its standard input, gives it a second to end by itself, then kills its group.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  enum class End {
    kLine,     ///< It answered.
    kClosed,   ///< It ended, or closed its standard output.
    kTimeout,  ///< The time was up.
    kFlood,    ///< It wrote more than kMostBytes without a line's end, several lines, or too much
               ///< on standard error.
  };
  struct Reply {
    End end;
    std::string line;  ///< Without the line's end.
  };
  static constexpr size_t kMostBytes = 1u << 20;        ///< Of one line.
  static constexpr size_t kMostErrorBytes = 16u << 20;  ///< On standard error, during one exchange.

  /// Writes one line and waits for one. What the program had said before is forgotten. After
  /// anything but kLine the program is of no use any more.
  Reply Exchange(std::string_view line, double limit_s);

  /// How long a program that has been told to end is waited for.
  static constexpr double kGrace_s = 1.0;
  /// Closes its standard input, waits for its end, then kills its group. For people: "it ended with
  /// exit code 3", "it was ended by signal 11 (Segmentation fault)", "it was still running".
  std::string Stop(double grace_s = kGrace_s);
  /// The last line that it wrote on standard error, at most 300 bytes; empty if there is none.
  std::string LastError() const;

 private:
  enum class Stream { kOpen, kDry, kEnded };

  /// Reads what is there into `text`.
  static Stream ReadSome(int file, std::string& text, size_t most);
  void ReadErrors();
  bool WriteSome(std::string_view& rest);
  void ForgetOutput();

  pid_t process_ = -1;
  int watch_ = -1;  ///< Readable when the process has ended (pidfd).
  int input_ = -1;
  int output_ = -1;
  int error_ = -1;
  std::string heard_;        ///< Of standard output, not yet taken.
  std::string last_errors_;  ///< The end of standard error.
  size_t error_bytes_ = 0;   ///< In this exchange.
};

}  // namespace fenestra
