#pragma once

#include <chrono>
#include <mutex>

namespace fenestra::cli {

/// A progress bar on standard error: only on a terminal, redrawn at most ten times a second, gone
/// when it ends. Thread-safe.
class ProgressBar {
 public:
  explicit ProgressBar(int total);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void Advance();

 private:
  void Draw() const;

  using SteadyTime = std::chrono::steady_clock::time_point;
  std::mutex mutex_;
  int total_;
  int done_ = 0;
  bool visible_;
  SteadyTime started_;
  SteadyTime drawn_;
};

}  // namespace fenestra::cli
