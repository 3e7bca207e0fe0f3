#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/trial_record.h"

namespace fenestra {

/// What a store says of itself: the study as written and as resolved, version, seed, libraries,
/// processor. Free keys; "schema_version" is written by the store.
using StoreMetadata = std::map<std::string, std::string>;

/// The raw rows of one run, in one SQLite file. Tables (see store_schema.h for the columns):
///
///     meta(key, value)     StoreMetadata
///     trials(...)          one row per TrialRecord, PRIMARY KEY (cell, trial, detector)
///
/// Everything else that a report shows is derived from these rows alone.
///
/// What is in the file at any time: whole trials only. All rows of a trial are written in one
/// transaction, with SQLite's rollback journal: a run that is killed keeps every finished trial,
/// and the trial that was being written is rolled back when the file is opened again. (Not a
/// write-ahead log: that keeps rows in a second file and does not work on network file systems.)
/// synchronous = NORMAL: a power failure cannot damage finished trials, at the price of a few
/// milliseconds a trial on a disk.
///
/// One process writes; any number may read, during the run, too. All members are thread-safe.
/// Errors: InputError for a file that is missing, damaged, of another program or version, or that
/// cannot be written; the file is then as it was.
class ResultStore {
 public:
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

  /// Adds one trial: its rows under all its detectors, which must agree in cell and trial. Either
  /// all of them are stored or, with an InputError, none (a row is already there, the disk is
  /// full).
  void AddTrial(std::span<const TrialRecord> rows);

  /// (cell, trial) of all trials that are stored.
  std::set<std::pair<int, int>> FinishedTrials() const;
  /// All rows, ordered by (cell, trial, detector), as they were added to the last bit.
  std::vector<TrialRecord> Rows() const;

  StoreMetadata Metadata() const;
  /// Adds or replaces one entry, such as the time at which the run ended.
  void SetMetadata(const std::string& key, const std::string& value);

 private:
  struct Connection;
  explicit ResultStore(std::unique_ptr<Connection> connection);

  std::unique_ptr<Connection> connection_;
};

}  // namespace fenestra
