#include "experiments/sqlite_database.h"

#include <fmt/format.h>

#include <cmath>

#include "core/check.h"
#include "core/input_error.h"

namespace fenestra {
namespace {

[[noreturn]] void ThrowError(const std::filesystem::path& file, sqlite3* connection, int code) {
  const char* text = connection != nullptr ? sqlite3_errmsg(connection) : sqlite3_errstr(code);
  throw InputError(file, fmt::format("SQLite says: {} (code {})", text, code));
}

int OpenFlags(SqliteDatabase::Mode mode) {
  switch (mode) {
    case SqliteDatabase::Mode::kReadOnly:
      return SQLITE_OPEN_READONLY;
    case SqliteDatabase::Mode::kReadWrite:
      return SQLITE_OPEN_READWRITE;
    case SqliteDatabase::Mode::kCreate:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  }
  FENESTRA_CHECK(false, "mode out of range");
}

}  // namespace

SqliteStatement& SqliteStatement::Bind(int64_t value) {
  Check(sqlite3_bind_int64(statement_.get(), next_parameter_++, value));
  return *this;
}

SqliteStatement& SqliteStatement::Bind(double value) {
  FENESTRA_CHECK(!std::isnan(value), "NaN for " + file_.string());
  Check(sqlite3_bind_double(statement_.get(), next_parameter_++, value));
  return *this;
}

SqliteStatement& SqliteStatement::Bind(std::string_view value) {
  // A null pointer would mean NULL, not the empty text.
  const char* bytes = value.empty() ? "" : value.data();
  Check(sqlite3_bind_text64(statement_.get(), next_parameter_++, bytes, value.size(),
                            SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

SqliteStatement& SqliteStatement::BindNull() {
  Check(sqlite3_bind_null(statement_.get(), next_parameter_++));
  return *this;
}

bool SqliteStatement::Step() {
  const int code = sqlite3_step(statement_.get());
  next_column_ = 0;
  if (code != SQLITE_ROW && code != SQLITE_DONE) {
    ThrowError(file_, sqlite3_db_handle(statement_.get()), code);
  }
  return code == SQLITE_ROW;
}

void SqliteStatement::Run() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_DONE) {
    FENESTRA_CHECK(code != SQLITE_ROW, "the statement gives rows");
    ThrowError(file_, sqlite3_db_handle(statement_.get()), code);
  }
  Reset();
}

void SqliteStatement::Reset() {
  sqlite3_reset(statement_.get());  // Its result repeats the error of the last step.
  next_parameter_ = 1;
}

int64_t SqliteStatement::ReadInteger() {
  return sqlite3_column_int64(statement_.get(), next_column_++);
}

std::string SqliteStatement::ReadText() {
  return ReadOptionalText().value_or("");
}

std::optional<std::string> SqliteStatement::ReadOptionalText() {
  const int column = next_column_++;
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
  const auto size = static_cast<size_t>(sqlite3_column_bytes(statement_.get(), column));
  return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
}

std::optional<double> SqliteStatement::ReadNumber() {
  const int column = next_column_++;
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
  return sqlite3_column_double(statement_.get(), column);
}

void SqliteStatement::Check(int code) const {
  if (code != SQLITE_OK) ThrowError(file_, sqlite3_db_handle(statement_.get()), code);
}

SqliteDatabase::SqliteDatabase(const std::filesystem::path& file, Mode mode) : file_(file) {
  sqlite3* connection = nullptr;
  // An absolute path, since SQLite gives names such as ":memory:" a meaning of their own.
  const std::string path = std::filesystem::absolute(file).string();
  const int code =
      sqlite3_open_v2(path.c_str(), &connection, OpenFlags(mode) | SQLITE_OPEN_NOMUTEX, nullptr);
  connection_.reset(connection);
  if (code != SQLITE_OK) ThrowError(file_, connection, code);
  sqlite3_busy_timeout(connection, 60'000);  // [ms]; readers may hold the file while they read.
}

void SqliteDatabase::Execute(const std::string& sql) {
  const int code = sqlite3_exec(connection_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) ThrowError(file_, connection_.get(), code);
}

SqliteStatement SqliteDatabase::Prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(connection_.get(), sql.c_str(), -1, &statement, nullptr);
  if (code != SQLITE_OK) ThrowError(file_, connection_.get(), code);
  return {statement, file_};
}

SqliteTransaction::SqliteTransaction(SqliteDatabase& database) : database_(database) {
  database_.Execute("BEGIN IMMEDIATE");
}

SqliteTransaction::~SqliteTransaction() {
  if (!open_) return;
  try {
    database_.Execute("ROLLBACK");
  } catch (const InputError&) {
    // SQLite has already rolled back, which some errors make it do.
  }
}

void SqliteTransaction::Commit() {
  database_.Execute("COMMIT");
  open_ = false;
}

}  // namespace fenestra
