#pragma once

#include "experiments/sqlite_database.h"
#include "experiments/trial_record.h"

namespace fenestra {

/// A TrialRecord to and from a row of the table `trials`; the column order is this pair's secret.

SqliteStatement PrepareInsert(SqliteDatabase& database);
/// Binds and runs the statement of PrepareInsert.
void InsertRow(SqliteStatement& insert, const TrialRecord& record);

/// Rows ordered by (cell, trial, detector).
SqliteStatement PrepareSelect(SqliteDatabase& database);
/// The current row. Throws std::runtime_error for a text that this program does not write.
TrialRecord ReadRow(SqliteStatement& select);

}  // namespace fenestra
