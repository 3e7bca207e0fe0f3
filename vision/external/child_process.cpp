#include "vision/external/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "core/io/system_error.h"

extern char** environ;

namespace fenestra {
namespace {

constexpr size_t kKeptErrorBytes = 4096;
constexpr size_t kLongestError = 300;

using SteadyTime = std::chrono::steady_clock::time_point;

SteadyTime In(double seconds) {
  return std::chrono::steady_clock::now() +
         std::chrono::ceil<std::chrono::milliseconds>(std::chrono::duration<double>(seconds));
}

// Remaining time for poll(); 0 when the limit is reached.
int MillisecondsUntil(SteadyTime time) {
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(time - std::chrono::steady_clock::now());
  return static_cast<int>(std::clamp<int64_t>(left.count(), 0, 3'600'000));
}

struct Pipe {
  int read = -1;
  int write = -1;

  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw SystemError(fmt::format("no pipe to a program can be made: {}", strerror(errno)));
    }
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    if (read >= 0) close(read);
    if (write >= 0) close(write);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  static int Keep(int& end) {
    fcntl(end, F_SETFL, fcntl(end, F_GETFL) | O_NONBLOCK);
    return std::exchange(end, -1);
  }
};

// The new process starts with default signal handling, whatever this one blocks or ignores, and
// inherits no other open files.
struct SpawnSettings {
  posix_spawnattr_t attributes{};
  posix_spawn_file_actions_t actions{};

  SpawnSettings(int input, int output, int error) {
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  }
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
};

// Writing to a program that has exited raises SIGPIPE, which would terminate this one. The signal
// is blocked in this thread only and then consumed, since other threads may want it.
class SigpipeHeldBack {
 public:
  SigpipeHeldBack() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~SigpipeHeldBack() {
    const timespec at_once{};
    while (!was_pending_ && sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  SigpipeHeldBack(const SigpipeHeldBack&) = delete;
  SigpipeHeldBack& operator=(const SigpipeHeldBack&) = delete;

 private:
  sigset_t pipe_{};
  sigset_t before_{};
  bool was_pending_ = false;
};

void Close(int& file) {
  if (file >= 0) close(file);
  file = -1;
}

}  // namespace

std::string Printable(std::string_view text, size_t most) {
  std::string line(text.substr(0, most));
  for (char& c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f) c = '?';
  }
  return line;
}

ChildProcess::ChildProcess(const std::vector<std::string>& words) {
  Pipe input, output, error;
  const SpawnSettings settings(input.read, output.write, error.write);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int failure = posix_spawnp(&process_, arguments[0], &settings.actions, &settings.attributes,
                                   arguments.data(), environ);
  if (failure != 0) {
    ThrowSystemFault(words.front(), "cannot be started", failure);
  }
  // Called by number, since the header of glibc 2.36 lacks its extern "C".
  watch_ = static_cast<int>(syscall(SYS_pidfd_open, process_, 0));
  input_ = Pipe::Keep(input.write);
  output_ = Pipe::Keep(output.read);
  error_ = Pipe::Keep(error.read);
}

ChildProcess::~ChildProcess() {
  Stop();
}

ChildProcess::Stream ChildProcess::ReadSome(int file, std::string& text, size_t most) {
  std::array<char, 65536> bytes;
  while (text.size() <= most) {
    const ssize_t count = read(file, bytes.data(), bytes.size());
    if (count > 0) {
      text.append(bytes.data(), static_cast<size_t>(count));
    } else if (count == 0) {
      return Stream::kEnded;
    } else if (errno != EINTR) {
      return errno == EAGAIN ? Stream::kDry : Stream::kEnded;
    }
  }
  return Stream::kOpen;
}

void ChildProcess::ReadErrors() {
  std::string text;
  if (error_ >= 0 && ReadSome(error_, text, kMostBytes) == Stream::kEnded) Close(error_);
  error_bytes_ += text.size();
  last_errors_ += text;
  if (last_errors_.size() > kKeptErrorBytes) {
    last_errors_.erase(0, last_errors_.size() - kKeptErrorBytes);
  }
}

// Returns false if the program no longer reads.
bool ChildProcess::WriteSome(std::string_view& rest) {
  const SigpipeHeldBack held;
  while (!rest.empty()) {
    const ssize_t count = write(input_, rest.data(), rest.size());
    if (count >= 0) {
      rest.remove_prefix(static_cast<size_t>(count));
    } else if (errno != EINTR) {
      return errno == EAGAIN;
    }
  }
  return true;
}

void ChildProcess::ForgetOutput() {
  heard_.clear();
  ReadSome(output_, heard_, kMostBytes);
  heard_.clear();
  ReadErrors();
  error_bytes_ = 0;
}

ChildProcess::Reply ChildProcess::Exchange(std::string_view line, double limit_s) {
  if (input_ < 0) return {End::kClosed, ""};
  const SteadyTime deadline = In(limit_s);
  ForgetOutput();
  const std::string text = std::string(line) + '\n';
  std::string_view rest = text;
  bool ended = !WriteSome(rest);
  while (true) {
    const Stream output = ReadSome(output_, heard_, kMostBytes);
    ReadErrors();
    if (const size_t end = heard_.find('\n'); end != std::string::npos) {
      const bool more = end + 1 != heard_.size();
      heard_.resize(end);
      return {more || end > kMostBytes ? End::kFlood : End::kLine, std::exchange(heard_, "")};
    }
    if (heard_.size() > kMostBytes || error_bytes_ > kMostErrorBytes) return {End::kFlood, ""};
    if (output == Stream::kEnded || ended) return {End::kClosed, ""};
    const int wait_ms = MillisecondsUntil(deadline);
    if (wait_ms == 0) return {End::kTimeout, ""};
    std::array<pollfd, 4> files = {{{output_, POLLIN, 0},
                                    {error_, POLLIN, 0},
                                    {watch_, POLLIN, 0},
                                    {rest.empty() ? -1 : input_, POLLOUT, 0}}};
    poll(files.data(), files.size(), wait_ms);
    // A process that has exited writes no more, so the rest of the pipe is read once.
    ended = ended || (files[2].revents & POLLIN) != 0;
    if (files[3].revents != 0) ended = !WriteSome(rest) || ended;
  }
}

std::string ChildProcess::Stop(double grace_s) {
  if (process_ < 0) return "";
  Close(input_);
  const SteadyTime deadline = In(grace_s);
  siginfo_t info{};
  while (waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == 0 && MillisecondsUntil(deadline) > 0) {
    pollfd watch{watch_, POLLIN, 0};
    poll(&watch, 1, MillisecondsUntil(deadline));
  }
  kill(-process_,
       SIGKILL);  // Must precede reaping the leader: until then the number belongs to its group.
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  ReadErrors();
  Close(output_);
  Close(error_);
  Close(watch_);
  if (info.si_pid == 0) return "it was still running";
  if (WIFEXITED(status)) return fmt::format("it ended with exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  return fmt::format("it was ended by signal {} ({})", signal, strsignal(signal));
}

std::string ChildProcess::LastError() const {
  const size_t last = last_errors_.find_last_not_of("\r\n \t");
  if (last == std::string::npos) return "";
  const size_t before = last_errors_.rfind('\n', last);
  const size_t start = before == std::string::npos ? 0 : before + 1;
  return Printable(std::string_view(last_errors_).substr(start, last + 1 - start), kLongestError);
}

}  // namespace fenestra
