#include "experiments/run/run_trials.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "core/system/check.h"
#include "experiments/trial/cell_runner.h"

namespace fenestra {
namespace {

RunnerMaker MakerOf(const RunOptions& options) {
  if (options.make_runner) return options.make_runner;
  return [detectors = options.detectors](const Study& study, const Cell& cell) {
    return std::make_shared<const CellRunner>(study, cell, detectors);
  };
}

// Makes each cell's runner when its first trial starts and drops it after its last one.
class Runners {
 public:
  Runners(const Study& study, std::span<const Cell> cells, std::span<const TrialKey> trials,
          RunnerMaker make_runner)
      : study_(study), cells_(cells), make_runner_(std::move(make_runner)), slots_(cells.size()) {
    for (const TrialKey& key : trials) ++slots_[static_cast<size_t>(key.cell)].remaining;
  }

  std::shared_ptr<const TrialRunner> Acquire(int cell) {
    Slot& slot = slots_[static_cast<size_t>(cell)];
    const std::lock_guard lock(slot.mutex);
    if (!slot.runner) {
      slot.runner = make_runner_(study_, cells_[static_cast<size_t>(cell)]);
    }
    return slot.runner;
  }

  void Release(int cell) {
    Slot& slot = slots_[static_cast<size_t>(cell)];
    const std::lock_guard lock(slot.mutex);
    if (--slot.remaining == 0) slot.runner.reset();
  }

 private:
  struct Slot {
    std::mutex mutex;
    std::shared_ptr<const TrialRunner> runner;
    int remaining = 0;
  };

  const Study& study_;
  std::span<const Cell> cells_;
  RunnerMaker make_runner_;
  std::vector<Slot> slots_;
};

}  // namespace

std::vector<TrialKey> AllTrials(std::span<const Cell> cells) {
  std::vector<TrialKey> trials;
  for (const Cell& cell : cells) {
    for (int trial = 0; trial < cell.repetitions; ++trial) trials.push_back({cell.index, trial});
  }
  return trials;
}

void RunTrials(const Study& study, std::span<const Cell> cells, std::span<const TrialKey> trials,
               const RunOptions& options, const std::function<void(const FinishedTrial&)>& finish) {
  FENESTRA_CHECK(options.jobs >= 1, "a run needs at least one job");
  Runners runners(study, cells, trials, MakerOf(options));
  std::atomic<size_t> next = 0;
  std::mutex error_mutex;
  std::exception_ptr first_error;

  const auto run_one = [&](TrialKey key) {
    const auto runner = runners.Acquire(key.cell);
    const SimulatedTrial simulated = runner->Simulate(key.trial);
    std::vector<Attempt> attempts;
    for (size_t i = 0; i < runner->detectors().size(); ++i) {
      attempts.push_back(runner->Try(i, simulated, options.keep_artifacts(key)));
    }
    finish({*runner, simulated, attempts});
    runners.Release(key.cell);
  };
  const auto work = [&] {
    try {
      for (size_t i = next++; i < trials.size() && !options.stop(); i = next++) run_one(trials[i]);
    } catch (...) {
      const std::lock_guard lock(error_mutex);
      if (!first_error) first_error = std::current_exception();
      next = trials.size();  // The other threads stop after their current trial.
    }
  };

  {
    std::vector<std::jthread> others;
    for (int i = 1; i < options.jobs; ++i) others.emplace_back(work);
    work();
  }
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace fenestra
