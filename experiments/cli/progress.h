#pragma once

#include <csignal>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>

#include "experiments/run/run_study.h"

namespace fenestra::cli {

/// How a run gets on: trials, rate, remaining time and each detector's hit rate so far. On a
/// terminal a line that is drawn anew, gone when the run ends; elsewhere a line now and then. Not
/// thread-safe.
class Progress {
 public:
  struct Options {
    bool terminal = false;
    int columns = 80;  ///< Width of the terminal.
    /// Time between plain lines; quicker runs print none.
    double line_interval_s = 30.0;
    std::function<double()> seconds;  ///< A clock that never goes back.
    std::function<void(const std::string&)> write;
  };

  /// For standard error, terminal or not.
  static Options ForStandardError();

  explicit Progress(Options options) : options_(std::move(options)) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Start(const RunStart& start);
  /// The rows of one trial.
  void Add(std::span<const TrialRecord> rows);

 private:
  void Show();
  std::string Bar() const;
  std::string Rate() const;

  Options options_;
  int64_t total_ = 0;
  int64_t done_ = 0;
  int64_t done_before_ = 0;
  std::map<std::string, DetectorTally> tallies_;
  double started_s_ = 0.0;
  double shown_s_ = 0.0;
  bool drawn_ = false;
};

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
