#include "experiments/store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <fstream>
#include <mutex>

#include "core/check.h"
#include "core/input_error.h"
#include "experiments/sqlite_database.h"
#include "experiments/store_rows.h"

namespace fenestra {
namespace fs = std::filesystem;
namespace {

constexpr char kRunColumns[] = "shard, started_utc, ended_utc, jobs, host, processor, command";

SqliteStatement PrepareInsertRun(SqliteDatabase& database) {
  return database.Prepare(
      fmt::format("INSERT INTO runs ({}) VALUES (?, ?, ?, ?, ?, ?, ?)", kRunColumns));
}

void InsertRun(SqliteStatement& insert, const RunEntry& run) {
  insert.Reset();
  insert.Bind(run.shard).Bind(run.started_utc);
  if (run.ended_utc) {
    insert.Bind(*run.ended_utc);
  } else {
    insert.BindNull();
  }
  insert.Bind(int64_t{run.jobs}).Bind(run.host).Bind(run.processor).Bind(run.command).Run();
}

SqliteStatement PrepareSelectRuns(SqliteDatabase& database) {
  return database.Prepare(fmt::format("SELECT {} FROM runs ORDER BY run", kRunColumns));
}

RunEntry ReadRun(SqliteStatement& select) {
  RunEntry run;
  run.shard = select.ReadText();
  run.started_utc = select.ReadText();
  run.ended_utc = select.ReadOptionalText();
  run.jobs = static_cast<int>(select.ReadInteger());
  run.host = select.ReadText();
  run.processor = select.ReadText();
  run.command = select.ReadText();
  return run;
}

fs::path JournalOf(const fs::path& file) {
  return file.string() + "-journal";
}

uint32_t BigEndian(std::span<const unsigned char, 4> bytes) {
  return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

/// Reads the header by hand, before SQLite gets to touch a file that may not be ours.
/// Source of the offsets: "SQLite database file format", section 1.3.
void CheckHeader(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw InputError(file, "there is no such file");
  std::array<char, 100> text{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(text.data(), text.size());
  std::array<unsigned char, 100> header{};
  std::copy(text.begin(), text.end(), header.begin());
  if (!stream || std::string_view(text.data(), 16) != std::string_view("SQLite format 3\0", 16)) {
    throw InputError(file, "is not a result store: it is not an SQLite file");
  }
  const std::span<const unsigned char, 100> bytes(header);
  if (BigEndian(bytes.subspan<68, 4>()) != kStoreApplicationId) {
    throw InputError(file, "is not a result store: it is an SQLite file of another program");
  }
  if (const uint32_t version = BigEndian(bytes.subspan<60, 4>()); version != kStoreSchemaVersion) {
    throw InputError(file, fmt::format("has schema version {}; this program knows version {} only",
                                       version, kStoreSchemaVersion));
  }
}

/// Throws InputError unless the file is a sound store.
void CheckStore(const fs::path& file) {
  CheckHeader(file);
  if (fs::exists(JournalOf(file))) {
    // A run may have been killed while it wrote. A reader could not roll that trial back.
    SqliteDatabase(file, SqliteDatabase::Mode::kReadWrite).Execute("SELECT count(*) FROM meta");
  }
  SqliteDatabase database(file, SqliteDatabase::Mode::kReadOnly);
  SqliteStatement check = database.Prepare("PRAGMA integrity_check(1)");
  check.Step();
  if (const std::string report = check.ReadText(); report != "ok") {
    throw InputError(file, "is damaged: " + report);
  }
  PrepareSelect(database);  // Throws where a column is missing.
  PrepareSelectRuns(database);
}

void WriteEmptyStore(const fs::path& file, const StoreMetadata& metadata) {
  SqliteDatabase database(file, SqliteDatabase::Mode::kCreate);
  SqliteTransaction transaction(database);
  database.Execute(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};",
                               kStoreApplicationId, kStoreSchemaVersion));
  database.Execute(kStoreSchema);
  SqliteStatement insert = database.Prepare("INSERT OR REPLACE INTO meta VALUES (?, ?)");
  for (const auto& [key, value] : metadata) insert.Bind(key).Bind(value).Run();
  insert.Bind("schema_version").Bind(std::to_string(kStoreSchemaVersion)).Run();
  transaction.Commit();
}

fs::path TemporaryBeside(const fs::path& file) {
  static std::atomic<unsigned> serial = 0;  // Two threads may write to one folder.
  return file.string() + fmt::format(".tmp{}-{}", getpid(), serial++);
}

}  // namespace

struct ResultStore::Connection {
  Connection(const fs::path& path, SqliteDatabase::Mode mode) : file(path), database(path, mode) {
    if (mode == SqliteDatabase::Mode::kReadOnly) return;
    database.Execute("PRAGMA synchronous = EXTRA");
    insert = PrepareInsert(database);
  }

  TrialRecord Read(SqliteStatement& select) const {
    try {
      return ReadRow(select);
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw InputError(file, fmt::format("a row does not make sense: {}", error.what()));
    }
  }

  fs::path file;
  std::mutex mutex;  ///< Guards everything below.
  SqliteDatabase database;
  std::optional<SqliteStatement> insert;  ///< Absent in a store that is open for reading only.
};

ResultStore::ResultStore(std::unique_ptr<Connection> connection)
    : connection_(std::move(connection)) {}
ResultStore::ResultStore(ResultStore&&) noexcept = default;
ResultStore& ResultStore::operator=(ResultStore&&) noexcept = default;
ResultStore::~ResultStore() = default;

ResultStore ResultStore::Create(const fs::path& file, const StoreMetadata& metadata,
                                IfExists if_exists) {
  if (fs::exists(file)) {
    if (if_exists == IfExists::kRefuse) throw InputError(file, "exists already");
    CheckStore(file);
  }
  std::error_code error;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  if (error) throw InputError(file, "its folder cannot be made: " + error.message());
  const fs::path temporary = TemporaryBeside(file);
  try {
    WriteEmptyStore(temporary, metadata);
    // The journal of a run that was killed and whose store was then deleted by hand: SQLite would
    // take it for the new file's and play it back.
    fs::remove(JournalOf(file));
    fs::rename(temporary, file);
  } catch (const std::exception& exception) {
    fs::remove(temporary, error);
    fs::remove(JournalOf(temporary), error);
    throw InputError(file, fmt::format("cannot be made: {}", exception.what()));
  }
  return ResultStore(std::make_unique<Connection>(file, SqliteDatabase::Mode::kReadWrite));
}

ResultStore ResultStore::Resume(const fs::path& file) {
  CheckStore(file);
  return ResultStore(std::make_unique<Connection>(file, SqliteDatabase::Mode::kReadWrite));
}

ResultStore ResultStore::OpenReadOnly(const fs::path& file) {
  CheckStore(file);
  return ResultStore(std::make_unique<Connection>(file, SqliteDatabase::Mode::kReadOnly));
}

void ResultStore::AddTrials(std::span<const std::vector<TrialRecord>> trials) {
  const std::lock_guard lock(connection_->mutex);
  FENESTRA_CHECK(connection_->insert.has_value(), "the store is open for reading only");
  SqliteTransaction transaction(connection_->database);
  for (const std::vector<TrialRecord>& rows : trials) {
    for (const TrialRecord& row : rows) {
      FENESTRA_CHECK(row.cell == rows.front().cell && row.trial == rows.front().trial,
                     "rows of two trials");
      InsertRow(*connection_->insert, row);
    }
  }
  transaction.Commit();
}

void ResultStore::AddTrial(std::span<const TrialRecord> rows) {
  const std::vector<TrialRecord> trial(rows.begin(), rows.end());
  AddTrials({&trial, 1});
}

std::vector<TrialKey> ResultStore::FinishedTrials() const {
  const std::lock_guard lock(connection_->mutex);
  SqliteStatement select =
      connection_->database.Prepare("SELECT DISTINCT cell, trial FROM trials ORDER BY cell, trial");
  std::vector<TrialKey> trials;
  while (select.Step()) {
    const auto cell = static_cast<int>(select.ReadInteger());
    const auto trial = static_cast<int>(select.ReadInteger());
    trials.push_back({cell, trial});
  }
  return trials;
}

void ResultStore::ForEachRow(const std::function<void(const TrialRecord&)>& visit) const {
  const std::lock_guard lock(connection_->mutex);
  SqliteStatement select = PrepareSelect(connection_->database);
  while (select.Step()) visit(connection_->Read(select));
}

std::vector<TrialRecord> ResultStore::Rows() const {
  std::vector<TrialRecord> rows;
  ForEachRow([&rows](const TrialRecord& row) { rows.push_back(row); });
  return rows;
}

std::vector<TrialRecord> ResultStore::RowsOf(TrialKey key) const {
  const std::lock_guard lock(connection_->mutex);
  SqliteStatement select = PrepareSelect(connection_->database, "WHERE cell = ? AND trial = ?");
  select.Bind(int64_t{key.cell}).Bind(int64_t{key.trial});
  std::vector<TrialRecord> rows;
  while (select.Step()) rows.push_back(connection_->Read(select));
  return rows;
}

std::vector<DetectorTally> ResultStore::Tallies() const {
  const std::lock_guard lock(connection_->mutex);
  SqliteStatement select = connection_->database.Prepare(
      "SELECT detector, sum(truth_x_m IS NOT NULL AND outcome <> 'out_of_view'), "
      "sum(outcome = 'hit') FROM trials GROUP BY detector ORDER BY detector");
  std::vector<DetectorTally> tallies;
  while (select.Step()) {
    DetectorTally tally;
    tally.detector = select.ReadText();
    tally.in_view = select.ReadInteger();
    tally.hits = select.ReadInteger();
    tallies.push_back(std::move(tally));
  }
  return tallies;
}

int64_t ResultStore::AddRun(const RunEntry& run) {
  const std::lock_guard lock(connection_->mutex);
  FENESTRA_CHECK(connection_->insert.has_value(), "the store is open for reading only");
  SqliteStatement insert = PrepareInsertRun(connection_->database);
  InsertRun(insert, run);
  return connection_->database.LastRowId();
}

void ResultStore::SetRunEnd(int64_t run, const std::string& ended_utc) {
  const std::lock_guard lock(connection_->mutex);
  FENESTRA_CHECK(connection_->insert.has_value(), "the store is open for reading only");
  connection_->database.Prepare("UPDATE runs SET ended_utc = ? WHERE run = ?")
      .Bind(ended_utc)
      .Bind(run)
      .Run();
}

std::vector<RunEntry> ResultStore::Runs() const {
  const std::lock_guard lock(connection_->mutex);
  SqliteStatement select = PrepareSelectRuns(connection_->database);
  std::vector<RunEntry> runs;
  while (select.Step()) runs.push_back(ReadRun(select));
  return runs;
}

StoreMetadata ResultStore::Metadata() const {
  const std::lock_guard lock(connection_->mutex);
  SqliteStatement select = connection_->database.Prepare("SELECT key, value FROM meta");
  StoreMetadata metadata;
  while (select.Step()) {
    std::string key = select.ReadText();
    metadata[std::move(key)] = select.ReadText();
  }
  return metadata;
}

}  // namespace fenestra
