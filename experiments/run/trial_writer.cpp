#include "experiments/run/trial_writer.h"

#include "core/system/check.h"

namespace fenestra {

TrialWriter::TrialWriter(ResultStore& store, Options options)
    : store_(store), options_(std::move(options)), thread_([this] { Work(); }) {}

TrialWriter::~TrialWriter() {
  try {
    Finish();
  } catch (const std::exception&) {
    // Whoever wants to know calls Finish.
  }
}

void TrialWriter::Add(std::vector<TrialRecord> rows) {
  std::unique_lock lock(mutex_);
  FENESTRA_CHECK(!finishing_, "the writer has finished");
  changed_.wait(lock, [this] { return error_ || waiting_.size() < options_.most_waiting; });
  RethrowError();
  waiting_.push_back(std::move(rows));
  if (waiting_.size() >= options_.most_waiting) changed_.notify_all();
}

void TrialWriter::Finish() {
  {
    const std::lock_guard lock(mutex_);
    finishing_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
  RethrowError();
}

void TrialWriter::Work() {
  std::unique_lock lock(mutex_);
  while (!error_) {
    changed_.wait_for(lock, options_.interval,
                      [this] { return finishing_ || waiting_.size() >= options_.most_waiting; });
    const bool last = finishing_;
    const Trials trials = std::exchange(waiting_, {});
    changed_.notify_all();
    lock.unlock();
    std::exception_ptr error;
    try {
      Store(trials);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    error_ = error;
    if (last) break;
  }
  changed_.notify_all();
}

void TrialWriter::Store(const Trials& trials) {
  if (trials.empty()) return;
  store_.AddTrials(trials);
  for (const std::vector<TrialRecord>& rows : trials) options_.on_stored(rows);
}

void TrialWriter::RethrowError() const {
  if (error_) std::rethrow_exception(error_);
}

}  // namespace fenestra
