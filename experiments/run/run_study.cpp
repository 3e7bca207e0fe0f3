#include "experiments/run/run_study.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iterator>
#include <optional>
#include <utility>

#include "core/io/input_error.h"
#include "core/system/program.h"
#include "experiments/analysis/trial_plan.h"
#include "experiments/run/result_files.h"
#include "experiments/run/run_identity.h"
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
                            {"shard", run.shard.ToString()}};
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

std::vector<TrialKey> Without(std::span<const TrialKey> trials, std::span<const TrialKey> stored) {
  std::vector<TrialKey> missing;
  std::set_difference(trials.begin(), trials.end(), stored.begin(), stored.end(),
                      std::back_inserter(missing));
  return missing;
}

// The store that this run continues, if there is one.
std::optional<ResultStore> OpenEarlier(const StudyRun& run, const std::filesystem::path& file) {
  if (run.restart || !std::filesystem::exists(file)) return std::nullopt;
  ResultStore store = ResultStore::Resume(file);
  CheckSame(store.Metadata(), run, file);
  return store;
}

ResultStore StartAfresh(const StudyRun& run, const std::filesystem::path& file) {
  ResultStore store = ResultStore::Create(file, MetadataOf(run), ResultStore::IfExists::kReplace);
  RemoveResultFiles(run.out);
  return store;
}

// Whether what is there decides which trials are run.
bool IsAdaptive(const Study& study) {
  return std::any_of(study.parts.begin(), study.parts.end(),
                     [](const StudyPart& part) { return part.until || part.envelope; });
}

std::vector<TrialKey> Missing(const StudyRun& run, std::span<const Cell> cells,
                              const ResultStore& store) {
  if (!IsAdaptive(run.study))
    return Without(run.shard.Of(AllTrials(cells)), store.FinishedTrials());
  TrialPlan plan(run.study, cells);
  store.ForEachRow([&](const TrialRecord& row) {
    RequireTrialOf(cells, row, StoreFile(run.out));
    plan.Add(row);
  });
  return plan.Next();
}

void CheckShard(const StudyRun& run) {
  if (run.shard.count == 1 || !IsAdaptive(run.study)) return;
  throw InputError("--shard",
                   "a study with until or envelope cannot be shared out: which trials it "
                   "runs depends on what all the others gave");
}

void RunBatch(const StudyRun& run, std::span<const Cell> cells, std::span<const TrialKey> batch,
              const std::function<bool()>& stop, ResultStore& store) {
  TrialWriter writer(store, {.interval = run.store_interval, .on_stored = run.on_stored});
  const auto pictured = [&run](TrialKey key) { return run.pictures && key.trial == 0; };
  const RunOptions options{.jobs = run.jobs,
                           .keep_artifacts = pictured,
                           .stop = stop,
                           .detectors = run.detectors,
                           .make_runner = run.make_runner};
  RunTrials(run.study, cells, batch, options, [&](const FinishedTrial& trial) {
    // Before the rows: a trial that is stored is not run again.
    if (pictured(trial.key())) WritePictures(PictureFolder(run.out, trial.runner.cell()), trial);
    writer.Add(trial.Records());
  });
  writer.Finish();
}

// Runs what is missing, and what turns out to be missing then. Returns whether all is there.
bool RunMissing(const StudyRun& run, std::span<const Cell> cells, std::vector<TrialKey> missing,
                ResultStore& store) {
  if (missing.empty()) return true;
  const int64_t entry = store.AddRun({.shard = run.shard.ToString(),
                                      .started_utc = UtcNow(),
                                      .ended_utc = std::nullopt,
                                      .jobs = run.jobs,
                                      .host = HostName(),
                                      .processor = Processor(),
                                      .command = run.command});
  std::atomic<bool> stopped = false;  // Told once, and still so when the batch has ended.
  const auto stop = [&run, &stopped] {
    if (run.stop()) stopped = true;
    return stopped.load();
  };
  while (!missing.empty() && !stopped) {
    RunBatch(run, cells, missing, stop, store);
    missing = Missing(run, cells, store);
  }
  store.SetRunEnd(entry, UtcNow());
  return missing.empty();
}

}  // namespace

StudyResult RunStudy(const StudyRun& run) {
  const std::vector<Cell> cells = Cells(run.study);
  const std::vector<TrialKey> trials = run.shard.Of(AllTrials(cells));
  const std::filesystem::path file = run.out / ResultStore::kFileName;
  CheckShard(run);
  run.detectors->Start(run.study);
  const FolderLock lock(run.out);

  RunStart start{.trials = static_cast<int64_t>(trials.size()), .stored = 0, .tallies = {}};
  std::optional<ResultStore> store = OpenEarlier(run, file);
  std::vector<TrialKey> missing;
  if (store) {
    missing = Missing(run, cells, *store);
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
    store = StartAfresh(run, file);
    missing = Missing(run, cells, *store);
  }
  const bool complete = RunMissing(run, cells, std::move(missing), *store);
  result.stored = static_cast<int64_t>(store->FinishedTrials().size());
  if (!complete) return result;
  result.trials = result.stored;  // A study that stops by itself knows its trials only now.
  result.summaries = WriteResultFiles(*store, run.study, cells, run.out);
  return result;
}

}  // namespace fenestra
