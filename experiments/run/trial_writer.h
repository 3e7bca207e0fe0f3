#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "experiments/store/store.h"

namespace fenestra {

/// Takes finished trials from any thread and stores them from a thread of its own, all that have
/// gathered in one transaction: a transaction waits for the disk, and trials should not.
class TrialWriter {
 public:
  struct Options {
    /// Trials wait at most this long: what a kill may cost, beside the trials that run.
    std::chrono::milliseconds interval{500};
    /// So many waiting trials are stored at once, so that quick trials do not fill the memory.
    size_t most_waiting = 1000;
    /// Called from the writer's thread when a trial is safely in the file, with its rows.
    std::function<void(std::span<const TrialRecord>)> on_stored = [](auto) {};
  };

  TrialWriter(ResultStore& store, Options options);
  /// Stores what is still waiting, if that is possible.
  ~TrialWriter();
  TrialWriter(const TrialWriter&) = delete;
  TrialWriter& operator=(const TrialWriter&) = delete;

  /// Throws what storing earlier trials threw. Waits while too many are waiting already.
  void Add(std::vector<TrialRecord> rows);
  /// Returns when everything is stored; throws what storing threw. Nothing can be added any more.
  void Finish();

 private:
  using Trials = std::vector<std::vector<TrialRecord>>;

  void Work();
  void Store(const Trials& trials);
  void RethrowError() const;

  ResultStore& store_;
  Options options_;
  std::mutex mutex_;  ///< Guards what follows.
  std::condition_variable changed_;
  Trials waiting_;
  bool finishing_ = false;
  std::exception_ptr error_;
  std::jthread thread_;
};

}  // namespace fenestra
