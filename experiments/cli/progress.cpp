#include "experiments/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

namespace fenestra::cli {

using std::chrono::duration;
using std::chrono::steady_clock;

ProgressBar::ProgressBar(int total)
    : total_(total),
      visible_(isatty(STDERR_FILENO) == 1),
      started_(steady_clock::now()),
      drawn_(started_) {
  if (visible_) Draw();
}

ProgressBar::~ProgressBar() {
  if (visible_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::Advance() {
  const std::lock_guard lock(mutex_);
  ++done_;
  const SteadyTime now = steady_clock::now();
  if (!visible_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  Draw();
}

void ProgressBar::Draw() const {
  constexpr int kWidth = 40;
  const double share = total_ > 0 ? static_cast<double>(done_) / total_ : 1.0;
  const int filled = static_cast<int>(share * kWidth);
  const double elapsed_s = duration<double>(steady_clock::now() - started_).count();
  std::string rest;
  if (done_ > 0) {
    const int left_s = static_cast<int>(elapsed_s / done_ * (total_ - done_) + 0.5);
    rest = fmt::format("  {:.1f}/s  {}:{:02} left", done_ / elapsed_s, left_s / 60, left_s % 60);
  }
  fmt::print(stderr, "\r\x1b[K[{}{}] {}/{} trials{}", std::string(static_cast<size_t>(filled), '#'),
             std::string(static_cast<size_t>(kWidth - filled), '.'), done_, total_, rest);
}

}  // namespace fenestra::cli
