#include "experiments/store/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <mutex>

#include "core/io/input_error.h"
#include "core/io/input_file.h"
#include "core/io/system_error.h"
#include "core/io/temporary_files.h"
#include "core/system/check.h"
#include "experiments/store/lock_wait.h"
#include "experiments/store/store_rows.h"

namespace fenestra {
namespace fs = std::filesystem;
namespace {

fs::path JournalOf(const fs::path& file) {
  return file.string() + "-journal";
}

uint32_t BigEndian(std::span<const unsigned char, 4> bytes) {
  return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

/// Reads the header by hand, before SQLite gets to touch a file that may not be ours.
/// Source of the offsets: "SQLite database file format", section 1.3.
void CheckHeader(const fs::path& file) {
  std::array<char, 100> text{};
  std::ifstream stream = OpenInput(file);
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

/// Whether it is the machine that failed, and not the file.
bool IsOfMachine(int code) {
  return code == SQLITE_FULL || code == SQLITE_IOERR || code == SQLITE_NOMEM || code == SQLITE_BUSY;
}

/// What `use` returns. An error of SQLite becomes an InputError or a SystemError that names the
/// file.
template <typename Use>
auto NamingFile(const fs::path& file, const Use& use) {
  try {
    return use();
  } catch (const SQLite::Exception& error) {
    const int code = error.getErrorCode();
    std::string message = fmt::format("SQLite says: {} (code {})", error.what(), code);
    if (code == SQLITE_BUSY) message += fmt::format("; it is locked by {}", LockHolders(file));
    if (IsOfMachine(code)) throw SystemError(file, message);
    throw InputError(file, message);
  }
}

SQLite::Database OpenDatabase(const fs::path& file, int flags) {
  // An absolute path, since SQLite gives names such as ":memory:" a meaning of their own.
  SQLite::Database database(fs::absolute(file).string(), flags | SQLite::OPEN_NOMUTEX);
  WaitForLocks(database.getHandle());
  return database;
}

/// Throws InputError unless the file is a sound store.
void CheckStore(const fs::path& file) {
  CheckHeader(file);
  NamingFile(file, [&file] {
    if (fs::exists(JournalOf(file))) {
      // A run may have been killed while it wrote. A reader could not roll that trial back.
      OpenDatabase(file, SQLite::OPEN_READWRITE).exec("SELECT count(*) FROM meta");
    }
    SQLite::Database database = OpenDatabase(file, SQLite::OPEN_READONLY);
    const std::string report = database.execAndGet("PRAGMA integrity_check(1)").getString();
    if (report != "ok") throw InputError(file, "is damaged: " + report);
    PrepareSelect(database);  // Throws where a column is missing.
    PrepareSelectRuns(database);
  });
}

void WriteEmptyStore(const fs::path& file, const StoreMetadata& metadata) {
  SQLite::Database database = OpenDatabase(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  database.exec(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};",
                            kStoreApplicationId, kStoreSchemaVersion));
  database.exec(kStoreSchema);
  StoreMetadata all = metadata;
  all["schema_version"] = std::to_string(kStoreSchemaVersion);
  SQLite::Statement insert(database, "INSERT INTO meta VALUES (?, ?)");
  for (const auto& [key, value] : all) {
    SQLite::bind(insert, key, value);
    insert.exec();
    insert.reset();
  }
  transaction.commit();
}

}  // namespace

struct ResultStore::Connection {
  Connection(const fs::path& path, int flags) : file(path), database(OpenDatabase(path, flags)) {
    if (flags == SQLite::OPEN_READONLY) return;
    database.exec("PRAGMA synchronous = EXTRA");
    insert.emplace(PrepareInsert(database));
  }

  static ResultStore Open(const fs::path& file, int flags) {
    return NamingFile(file, [&] { return ResultStore(std::make_unique<Connection>(file, flags)); });
  }

  /// What `use` returns, while nobody else uses the connection.
  template <typename Use>
  auto Alone(const Use& use) {
    const std::lock_guard lock(mutex);
    return NamingFile(file, use);
  }

  TrialRecord Read(const SQLite::Statement& select) const {
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
  SQLite::Database database;
  std::optional<SQLite::Statement> insert;  ///< Absent in a store that is open for reading only.
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
  if (error) ThrowSystemFault(file, "its folder cannot be made", error.value());
  const fs::path temporary = TemporaryBeside(file);
  const auto remove_temporary = [&] {
    fs::remove(temporary, error);
    fs::remove(JournalOf(temporary), error);
  };
  try {
    NamingFile(temporary, [&] { WriteEmptyStore(temporary, metadata); });
    // The journal of a run that was killed and whose store was then deleted by hand: SQLite would
    // take it for the new file's and play it back.
    fs::remove(JournalOf(file));
    fs::rename(temporary, file);
  } catch (const SystemError& failure) {
    remove_temporary();
    throw SystemError(file, fmt::format("cannot be made: {}", failure.what()));
  } catch (const std::exception& fault) {
    remove_temporary();
    throw InputError(file, fmt::format("cannot be made: {}", fault.what()));
  }
  return Connection::Open(file, SQLite::OPEN_READWRITE);
}

ResultStore ResultStore::Resume(const fs::path& file) {
  CheckStore(file);
  return Connection::Open(file, SQLite::OPEN_READWRITE);
}

ResultStore ResultStore::OpenReadOnly(const fs::path& file) {
  CheckStore(file);
  return Connection::Open(file, SQLite::OPEN_READONLY);
}

void ResultStore::AddTrials(std::span<const std::vector<TrialRecord>> trials) {
  connection_->Alone([&] {
    FENESTRA_CHECK(connection_->insert.has_value(), "the store is open for reading only");
    SQLite::Transaction transaction(connection_->database, SQLite::TransactionBehavior::IMMEDIATE);
    for (const std::vector<TrialRecord>& rows : trials) {
      for (const TrialRecord& row : rows) {
        FENESTRA_CHECK(row.cell == rows.front().cell && row.trial == rows.front().trial,
                       "rows of two trials");
        InsertRow(*connection_->insert, row);
      }
    }
    transaction.commit();
  });
}

void ResultStore::AddTrial(std::span<const TrialRecord> rows) {
  const std::vector<TrialRecord> trial(rows.begin(), rows.end());
  AddTrials({&trial, 1});
}

std::vector<TrialKey> ResultStore::FinishedTrials() const {
  return connection_->Alone([this] {
    SQLite::Statement select(connection_->database,
                             "SELECT DISTINCT cell, trial FROM trials ORDER BY cell, trial");
    std::vector<TrialKey> trials;
    while (select.executeStep()) {
      trials.push_back({select.getColumn(0).getInt(), select.getColumn(1).getInt()});
    }
    return trials;
  });
}

void ResultStore::ForEachRow(const std::function<void(const TrialRecord&)>& visit) const {
  connection_->Alone([&] {
    SQLite::Statement select = PrepareSelect(connection_->database);
    while (select.executeStep()) visit(connection_->Read(select));
  });
}

std::vector<TrialRecord> ResultStore::Rows() const {
  std::vector<TrialRecord> rows;
  ForEachRow([&rows](const TrialRecord& row) { rows.push_back(row); });
  return rows;
}

std::vector<TrialRecord> ResultStore::RowsOf(TrialKey key) const {
  return connection_->Alone([&] {
    SQLite::Statement select = PrepareSelect(connection_->database, "WHERE cell = ? AND trial = ?");
    SQLite::bind(select, key.cell, key.trial);
    std::vector<TrialRecord> rows;
    while (select.executeStep()) rows.push_back(connection_->Read(select));
    return rows;
  });
}

std::vector<DetectorTally> ResultStore::Tallies() const {
  return connection_->Alone([this] {
    SQLite::Statement select(
        connection_->database,
        "SELECT detector, sum(truth_x_m IS NOT NULL AND outcome <> 'out_of_view'), "
        "sum(outcome = 'hit') FROM trials GROUP BY detector ORDER BY detector");
    std::vector<DetectorTally> tallies;
    while (select.executeStep()) {
      tallies.push_back({.detector = select.getColumn(0).getString(),
                         .in_view = select.getColumn(1).getInt64(),
                         .hits = select.getColumn(2).getInt64()});
    }
    return tallies;
  });
}

int64_t ResultStore::AddRun(const RunEntry& run) {
  return connection_->Alone([&] {
    FENESTRA_CHECK(connection_->insert.has_value(), "the store is open for reading only");
    SQLite::Statement insert = PrepareInsertRun(connection_->database);
    InsertRun(insert, run);
    return connection_->database.getLastInsertRowid();
  });
}

void ResultStore::SetRunEnd(int64_t run, const std::string& ended_utc) {
  connection_->Alone([&] {
    FENESTRA_CHECK(connection_->insert.has_value(), "the store is open for reading only");
    SQLite::Statement update(connection_->database, "UPDATE runs SET ended_utc = ? WHERE run = ?");
    SQLite::bind(update, ended_utc, run);
    update.exec();
  });
}

std::vector<RunEntry> ResultStore::Runs() const {
  return connection_->Alone([this] {
    SQLite::Statement select = PrepareSelectRuns(connection_->database);
    std::vector<RunEntry> runs;
    while (select.executeStep()) runs.push_back(ReadRun(select));
    return runs;
  });
}

StoreMetadata ResultStore::Metadata() const {
  return connection_->Alone([this] {
    SQLite::Statement select(connection_->database, "SELECT key, value FROM meta");
    StoreMetadata metadata;
    while (select.executeStep()) {
      metadata[select.getColumn(0).getString()] = select.getColumn(1).getString();
    }
    return metadata;
  });
}

}  // namespace fenestra
