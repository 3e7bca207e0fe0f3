#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/store/store_metadata.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// The raw rows of one study, in one SQLite file. Tables (see store_rows.h for the columns):
///
///     meta(key, value)     StoreMetadata
///     runs(...)            one row per RunEntry
///     trials(...)          one row per TrialRecord, PRIMARY KEY (cell, trial, detector)
///
/// Everything else that a report shows is derived from these rows alone.
///
/// The file holds whole trials only, at any time. Trials are written in transactions with
/// SQLite's rollback journal: a run that is killed keeps every trial whose AddTrials has returned,
/// and what was being written is rolled back when the file is opened again. (Not a write-ahead log:
/// that keeps rows in a second file and does not work on network file systems.) synchronous =
/// EXTRA: the same holds after a power failure. A transaction costs some milliseconds on a disk,
/// which is why TrialWriter gathers trials.
///
/// One process writes; any number may read, during the run, too: who keeps a place in the file is
/// waited for (LockPatience). All members are thread-safe. Errors: InputError for a file that is
/// missing, damaged, of another program or version, or that may not be written, SystemError for a
/// full disk or a lock that outlasts all patience; the file is then as it was.
class ResultStore {
 public:
  /// Name of a store in a results folder.
  static constexpr char kFileName[] = "results.sqlite";

  enum class IfExists { kRefuse, kReplace };

  /// Makes a fresh, empty store, which appears by rename: until then an older result stands, and a
  /// run that fails to start leaves nothing. kReplace replaces a sound store and nothing else.
  static ResultStore Create(const std::filesystem::path& file, const StoreMetadata& metadata,
                            IfExists if_exists = IfExists::kRefuse);
  /// Opens a store to add the trials that are missing.
  static ResultStore Resume(const std::filesystem::path& file);
  static ResultStore OpenReadOnly(const std::filesystem::path& file);

  ResultStore(ResultStore&&) noexcept;
  ResultStore& operator=(ResultStore&&) noexcept;
  ~ResultStore();

  /// Adds trials: of each its rows under all its detectors, which must agree in cell and trial.
  /// Either all of them are stored or, with an InputError (a row is already there) or a SystemError
  /// (the disk is full), none.
  void AddTrials(std::span<const std::vector<TrialRecord>> trials);
  void AddTrial(std::span<const TrialRecord> rows);

  /// All trials that are stored, in ascending order.
  std::vector<TrialKey> FinishedTrials() const;
  /// Shows every row to `visit`, ordered by (cell, trial, detector), as it was added to the last
  /// bit. `visit` must not use this store.
  void ForEachRow(const std::function<void(const TrialRecord&)>& visit) const;
  std::vector<TrialRecord> Rows() const;
  /// The rows of one trial, by detector; none if it is not stored.
  std::vector<TrialRecord> RowsOf(TrialKey key) const;

  /// One for each detector, by name.
  std::vector<DetectorTally> Tallies() const;

  /// Adds a row to the table `runs` and returns its number.
  int64_t AddRun(const RunEntry& run);
  void SetRunEnd(int64_t run, const std::string& ended_utc);
  std::vector<RunEntry> Runs() const;

  StoreMetadata Metadata() const;

 private:
  struct Connection;
  explicit ResultStore(std::unique_ptr<Connection> connection);

  std::unique_ptr<Connection> connection_;
};

}  // namespace fenestra
