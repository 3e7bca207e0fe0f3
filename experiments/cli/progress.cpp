#include "experiments/cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "experiments/output/number_format.h"

namespace fenestra::cli {
namespace {

constexpr double kRedraw_s = 0.2;
constexpr int kBarWidth = 24;

std::string HitRate(const DetectorTally& tally) {
  if (tally.in_view == 0) return "-";
  return Percent(static_cast<double>(tally.hits) / static_cast<double>(tally.in_view), 0);
}

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

Progress::Options Progress::ForStandardError() {
  winsize size{};
  const char* const kind = std::getenv("TERM");
  // A dumb terminal shows control sequences as they are.
  const bool terminal = isatty(STDERR_FILENO) == 1 && kind != nullptr && *kind != '\0' &&
                        std::string_view(kind) != "dumb";
  if (terminal) ioctl(STDERR_FILENO, TIOCGWINSZ, &size);
  return {.terminal = terminal,
          .columns = size.ws_col > 0 ? size.ws_col : 80,
          .seconds =
              [] {
                const auto now = std::chrono::steady_clock::now().time_since_epoch();
                return std::chrono::duration<double>(now).count();
              },
          .write =
              [](const std::string& text) {
                std::fputs(text.c_str(), stderr);  // Losing it stops no run.
                std::fflush(stderr);
              }};
}

Progress::~Progress() {
  if (drawn_) options_.write("\r\x1b[K");
}

void Progress::Start(const RunStart& start) {
  total_ = start.trials;
  done_ = done_before_ = start.stored;
  for (const DetectorTally& tally : start.tallies) tallies_[tally.detector] = tally;
  started_s_ = shown_s_ = options_.seconds();
  if (done_before_ > 0) {
    options_.write(fmt::format("{} of {} trials are stored already\n", done_before_, total_));
  }
  if (options_.terminal) Show();
}

void Progress::Add(std::span<const TrialRecord> rows) {
  ++done_;
  for (const TrialRecord& row : rows) {
    DetectorTally& tally = tallies_[row.detector];
    tally.detector = row.detector;
    if (row.score.outcome == Outcome::kHit) ++tally.hits;
    if (row.score.IsAttempt()) ++tally.in_view;
  }
  const double interval_s = options_.terminal ? kRedraw_s : options_.line_interval_s;
  if (options_.seconds() - shown_s_ >= interval_s) Show();
}

void Progress::Show() {
  shown_s_ = options_.seconds();
  std::string text = fmt::format("{}/{} trials{}", done_, total_, Rate());
  bool first = true;
  for (const auto& [detector, tally] : tallies_) {
    text += fmt::format("{}{} {}", first ? "  hits: " : ", ", detector, HitRate(tally));
    first = false;
  }
  if (!options_.terminal) {
    options_.write(text + "\n");
    return;
  }
  text = Bar() + text;
  // One that is too long for its line could not be drawn over.
  text.resize(std::min(text.size(), static_cast<size_t>(std::max(options_.columns - 1, 0))));
  options_.write("\r\x1b[K" + text);
  drawn_ = true;
}

std::string Progress::Bar() const {
  const double share = total_ > 0 ? static_cast<double>(done_) / static_cast<double>(total_) : 1.0;
  const auto filled = static_cast<size_t>(share * kBarWidth);
  return "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "] ";
}

std::string Progress::Rate() const {
  const double elapsed_s = shown_s_ - started_s_;
  if (done_ == done_before_ || elapsed_s <= 0.0) return "";
  const double rate = static_cast<double>(done_ - done_before_) / elapsed_s;
  const double left_s = std::round(static_cast<double>(total_ - done_) / rate);
  // A guess: tenths of a second would only flicker.
  const std::string left = left_s < 60.0 ? fmt::format("{:.0f} s", left_s) : Duration(left_s);
  return fmt::format("  {:.1f}/s  {} left", rate, left);
}

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
