#pragma once

#include "experiments/sqlite_database.h"
#include "experiments/store.h"
#include "experiments/trial_record.h"

namespace fenestra {

/// A TrialRecord to and from a row of the table `trials`, a RunEntry to and from one of `runs`; the
/// column order is this file's secret.

SqliteStatement PrepareInsert(SqliteDatabase& database);
/// Binds and runs the statement of PrepareInsert.
void InsertRow(SqliteStatement& insert, const TrialRecord& record);

/// Rows ordered by (cell, trial, detector); `condition` such as "WHERE cell = ?".
SqliteStatement PrepareSelect(SqliteDatabase& database, const std::string& condition = "");
/// The current row. Throws std::runtime_error for a text that this program does not write.
TrialRecord ReadRow(SqliteStatement& select);

SqliteStatement PrepareInsertRun(SqliteDatabase& database);
void InsertRun(SqliteStatement& insert, const RunEntry& run);
SqliteStatement PrepareSelectRuns(SqliteDatabase& database);
RunEntry ReadRun(SqliteStatement& select);

}  // namespace fenestra
