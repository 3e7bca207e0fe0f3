#include "experiments/run/run_trials.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "core/system/check.h"
#include "experiments/trial/cell_bench.h"

namespace fenestra {
namespace {

BenchMaker MakerOf(const RunOptions& options) {
  if (options.make_bench) return options.make_bench;
  return [detectors = options.detectors](const Study& study, const Cell& cell) {
    return std::make_shared<const CellBench>(study, cell, detectors);
  };
}

// Makes each cell's bench when its first trial starts and drops it after its last one.
class Benches {
 public:
  Benches(const Study& study, std::span<const Cell> cells, std::span<const TrialKey> trials,
          BenchMaker make_bench)
      : study_(study), cells_(cells), make_bench_(std::move(make_bench)), slots_(cells.size()) {
    for (const TrialKey& key : trials) ++slots_[static_cast<size_t>(key.cell)].remaining;
  }

  std::shared_ptr<const TrialBench> Acquire(int cell) {
    Slot& slot = slots_[static_cast<size_t>(cell)];
    const std::lock_guard lock(slot.mutex);
    if (!slot.bench) {
      slot.bench = make_bench_(study_, cells_[static_cast<size_t>(cell)]);
    }
    return slot.bench;
  }

  void Release(int cell) {
    Slot& slot = slots_[static_cast<size_t>(cell)];
    const std::lock_guard lock(slot.mutex);
    if (--slot.remaining == 0) slot.bench.reset();
  }

 private:
  struct Slot {
    std::mutex mutex;
    std::shared_ptr<const TrialBench> bench;
    int remaining = 0;
  };

  const Study& study_;
  std::span<const Cell> cells_;
  BenchMaker make_bench_;
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
  Benches benches(study, cells, trials, MakerOf(options));
  std::atomic<size_t> next = 0;
  std::mutex error_mutex;
  std::exception_ptr first_error;

  const auto run_one = [&](TrialKey key) {
    const auto bench = benches.Acquire(key.cell);
    const SimulatedTrial simulated = bench->Simulate(key.trial);
    std::vector<Attempt> attempts;
    for (size_t i = 0; i < bench->detectors().size(); ++i) {
      attempts.push_back(bench->Try(i, simulated, options.keep_artifacts(key)));
    }
    finish({*bench, simulated, attempts});
    benches.Release(key.cell);
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
