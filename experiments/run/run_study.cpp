#include "experiments/run/run_study.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <utility>

#include "core/io/input_error.h"
#include "core/system/program.h"
#include "experiments/run/result_files.h"
#include "experiments/run/run_identity.h"
#include "experiments/run/stored_study.h"
#include "experiments/run/trial_writer.h"
#include "experiments/store/store.h"
#include "experiments/trial_files/trial_files.h"

namespace fenestra {
namespace {

std::string UtcNow() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

StoreMetadata MetadataOf(const StudyRun& run) {
  StoreMetadata metadata = {{"study_text", run.study_text},
                            {"name", run.study.name},
                            {"description", run.study.description},
                            {"seed", std::to_string(run.study.seed)},
                            {"shard", run.shard.ToString()},
                            {"started_in", std::filesystem::current_path().string()}};
  AddTo(metadata, IdentityOf(run.study));
  return metadata;
}

// Throws unless the rows of the store are those that this run would make.
void CheckSame(const StoreMetadata& there, const StudyRun& run, const std::filesystem::path& file) {
  std::vector<std::string> differences = Differences(IdentityFrom(there), IdentityOf(run.study));
  if (there.at("shard") != run.shard.ToString()) {
    differences.push_back(
        fmt::format("shard: {} there, {} here", there.at("shard"), run.shard.ToString()));
  }
  if (differences.empty()) return;
  throw InputError(file, fmt::format("holds another result, which this run cannot continue. {}. "
                                     "Choose another --out, or replace it with --restart",
                                     fmt::join(differences, "; ")));
}

// The store that this run continues, if there is one.
std::optional<ResultStore> OpenEarlier(const StudyRun& run, const std::filesystem::path& file) {
  if (run.restart || !std::filesystem::exists(file)) return std::nullopt;
  ResultStore store = ResultStore::Resume(file);
  CheckSame(store.Metadata(), run, file);
  return store;
}

ResultStore StartAfresh(const StudyRun& run, const OutputPath& out) {
  const std::filesystem::path file = out.path() / ResultStore::kFileName;
  out.StartRecord();
  ResultStore store = ResultStore::Create(file, MetadataOf(run), ResultStore::IfExists::kReplace);
  RemoveResultFiles(out);
  return store;
}

void CheckShard(const StudyRun& run) {
  if (run.shard.count == 1 || !IsAdaptive(run.study)) return;
  throw InputError("--shard",
                   "a study with until or envelope cannot be shared out: which trials it "
                   "runs depends on what all the others gave");
}

// Adds what is missing to a store.
class StoreFiller {
 public:
  StoreFiller(const StudyRun& run, std::span<const Cell> cells, const OutputPath& out,
              ResultStore& store)
      : run_(run), cells_(cells), out_(out), store_(store) {}

  // Runs these trials, and those that turn out to be missing then (of all that are `wanted`).
  // Returns whether all is there.
  bool Run(std::vector<TrialKey> missing, std::span<const TrialKey> wanted) {
    if (missing.empty()) return true;
    const int64_t entry = store_.AddRun({.shard = run_.shard.ToString(),
                                         .started_utc = UtcNow(),
                                         .ended_utc = std::nullopt,
                                         .jobs = run_.jobs,
                                         .host = HostName(),
                                         .processor = Processor(),
                                         .command = run_.command});
    while (!missing.empty() && !stopped_) {
      RunBatch(missing);
      missing = MissingTrials(run_.study, cells_, wanted, store_, run_.out);
    }
    store_.SetRunEnd(entry, UtcNow());
    return missing.empty();
  }

 private:
  void RunBatch(std::span<const TrialKey> batch) {
    TrialWriter writer(store_, {.interval = run_.store_interval, .on_stored = run_.on_stored});
    const auto pictured = [this](TrialKey key) { return run_.pictures && key.trial == 0; };
    const auto stop = [this] {
      if (run_.stop()) stopped_ = true;
      return stopped_.load();
    };
    const RunOptions options{.jobs = run_.jobs,
                             .keep_artifacts = pictured,
                             .stop = stop,
                             .detectors = run_.detectors,
                             .make_runner = run_.make_runner};
    RunTrials(run_.study, cells_, batch, options, [&](const FinishedTrial& trial) {
      // Before the rows: a trial that is stored is not run again.
      if (pictured(trial.key())) WritePictures(PictureFolder(out_, trial.runner.cell()), trial);
      writer.Add(trial.Records());
    });
    writer.Finish();
  }

  const StudyRun& run_;
  std::span<const Cell> cells_;
  const OutputPath& out_;
  ResultStore& store_;
  std::atomic<bool> stopped_ = false;  // Told once, and still so when a batch has ended.
};

}  // namespace

StudyResult RunStudy(const StudyRun& run) {
  const std::vector<Cell> cells = Cells(run.study);
  const std::vector<TrialKey> trials = run.shard.Of(AllTrials(cells));
  const std::filesystem::path file = run.out / ResultStore::kFileName;
  CheckShard(run);
  run.detectors->Start(run.study);
  const FolderLock lock(run.out);
  const OutputPath out = ResultsFolder(run.out);

  RunStart start{.trials = static_cast<int64_t>(trials.size()), .stored = 0, .tallies = {}};
  std::optional<ResultStore> store = OpenEarlier(run, file);
  std::vector<TrialKey> missing;
  if (store) {
    missing = MissingTrials(run.study, cells, trials, *store, file);
    start.stored = static_cast<int64_t>(store->FinishedTrials().size());
    start.tallies = store->Tallies();
  }
  const bool was_complete = store && missing.empty();
  StudyResult result{.trials = was_complete ? start.stored : start.trials,
                     .stored_before = start.stored,
                     .stored = start.stored,
                     .summaries = {}};
  if (was_complete && HasResultFiles(run.out)) {
    result.summaries = Summarise(*store, RowContext(run.study, cells));
    return result;
  }
  run.on_start(start);
  if (!store) {
    store = StartAfresh(run, out);
    missing = MissingTrials(run.study, cells, trials, *store, file);
  }
  const bool complete = StoreFiller(run, cells, out, *store).Run(std::move(missing), trials);
  result.stored = static_cast<int64_t>(store->FinishedTrials().size());
  if (!complete) return result;
  result.trials = result.stored;  // A study that stops by itself knows its trials only now.
  result.summaries = WriteResultFiles(*store, run.study, cells, out);
  return result;
}

}  // namespace fenestra
