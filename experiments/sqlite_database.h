#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace fenestra {

/// A prepared SQL statement. Parameters count from 1 and columns from 0, as in SQLite. Reading and
/// binding doubles keeps their bits; NaN cannot be stored (SQLite makes it NULL) and fails a check.
class SqliteStatement {
 public:
  /// The next parameter, in order.
  SqliteStatement& Bind(int64_t value);
  SqliteStatement& Bind(double value);
  SqliteStatement& Bind(std::string_view value);
  SqliteStatement& BindNull();

  /// Runs to the next row; false at the end. Throws InputError.
  bool Step();
  /// Runs a statement that gives no rows and resets it.
  void Run();
  /// Makes the statement ready for new parameters, also after an exception half-way.
  void Reset();

  /// The next column of the current row, in order.
  int64_t ReadInteger();
  std::string ReadText();
  std::optional<double> ReadNumber();
  std::optional<std::string> ReadOptionalText();

 private:
  friend class SqliteDatabase;
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  SqliteStatement(sqlite3_stmt* statement, std::filesystem::path file)
      : statement_(statement), file_(std::move(file)) {}
  void Check(int code) const;

  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
  std::filesystem::path file_;
  int next_parameter_ = 1;
  int next_column_ = 0;
};

/// One connection to an SQLite file; not thread-safe. All errors of SQLite become InputErrors that
/// name the file.
class SqliteDatabase {
 public:
  enum class Mode { kReadOnly, kReadWrite, kCreate };

  SqliteDatabase(const std::filesystem::path& file, Mode mode);

  /// One or several statements without parameters and results.
  void Execute(const std::string& sql);
  SqliteStatement Prepare(const std::string& sql);
  /// The number of the row that was inserted last, in a table that has one.
  int64_t LastRowId() const { return sqlite3_last_insert_rowid(connection_.get()); }

 private:
  struct Closer {
    void operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }
  };

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Closer> connection_;
};

/// Begins a transaction that is rolled back unless it is committed.
class SqliteTransaction {
 public:
  explicit SqliteTransaction(SqliteDatabase& database);
  ~SqliteTransaction();
  SqliteTransaction(const SqliteTransaction&) = delete;
  SqliteTransaction& operator=(const SqliteTransaction&) = delete;

  void Commit();

 private:
  SqliteDatabase& database_;
  bool open_ = true;
};

}  // namespace fenestra
