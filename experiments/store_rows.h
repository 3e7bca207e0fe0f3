#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiments/store.h"
#include "experiments/trial_record.h"

namespace fenestra {

/// A TrialRecord to and from a row of the table `trials`, a RunEntry to and from one of `runs`; the
/// column order is this file's secret. Doubles keep their bits; NaN fails a check. Errors of SQLite
/// are thrown as they are, SQLite::Exception.

SQLite::Statement PrepareInsert(const SQLite::Database& database);
/// Binds and runs the statement of PrepareInsert.
void InsertRow(SQLite::Statement& insert, const TrialRecord& record);

/// Rows ordered by (cell, trial, detector); `condition` such as "WHERE cell = ?".
SQLite::Statement PrepareSelect(const SQLite::Database& database,
                                const std::string& condition = "");
/// The current row. Throws std::runtime_error for a text that this program does not write.
TrialRecord ReadRow(const SQLite::Statement& select);

SQLite::Statement PrepareInsertRun(const SQLite::Database& database);
void InsertRun(SQLite::Statement& insert, const RunEntry& run);
SQLite::Statement PrepareSelectRuns(const SQLite::Database& database);
RunEntry ReadRun(const SQLite::Statement& select);

}  // namespace fenestra
