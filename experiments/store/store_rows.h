#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string>

#include "experiments/store/store_metadata.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// Bytes 68–71 of the file, big-endian: "Fene". Tells Fenestra's files from other SQLite files.
inline constexpr uint32_t kStoreApplicationId = 0x46656e65;
/// Bytes 60–63 of the file. Counts up with every change to the tables.
inline constexpr uint32_t kStoreSchemaVersion = 3;

/// Numbers of estimate and truth are declared ANY: a REAL column would keep a whole number as an
/// integer and so lose the sign of -0.0. The columns centroid_error_* repeat estimate minus truth
/// in millimetres for queries; they are not read back.
inline constexpr char kStoreSchema[] = R"sql(
CREATE TABLE meta (
  key   TEXT PRIMARY KEY,
  value TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE runs (                  -- one row per call of the program that added trials
  run         INTEGER PRIMARY KEY,   -- from 1
  shard       TEXT NOT NULL,         -- "2/8"; "1/1" is the whole study
  started_utc TEXT NOT NULL,         -- 2026-01-31T12:00:00Z
  ended_utc   TEXT,                  -- NULL: still running, or killed
  jobs        INTEGER NOT NULL,
  host        TEXT NOT NULL,
  processor   TEXT NOT NULL,
  command     TEXT NOT NULL
) STRICT;

CREATE TABLE trials (
  cell                INTEGER NOT NULL,
  trial               INTEGER NOT NULL,
  detector            TEXT NOT NULL,
  part                TEXT NOT NULL,
  sensor              TEXT NOT NULL,  -- stereo, rgbd
  levels              TEXT NOT NULL,  -- JSON {"distance_m": 1.4, ...}, the same for all of a cell
  drawn               TEXT NOT NULL,  -- JSON, drawn anew in every trial
  outcome             TEXT NOT NULL,  -- hit, gross, wrong_window, missed, crashed, out_of_view,
                                      -- false_alarm, clear
  reason              TEXT NOT NULL,  -- of a miss or a crash
  detail              TEXT NOT NULL,
  centroid_error_x_mm REAL,           -- to the right
  centroid_error_y_mm REAL,           -- down
  centroid_error_z_mm REAL,           -- in depth
  centroid_error_mm   REAL,           -- length of the three
  estimate_x_m        ANY,            -- centroid in the scored camera's frame
  estimate_y_m        ANY,
  estimate_z_m        ANY,
  estimate_normal_x   ANY,            -- unit vector
  estimate_normal_y   ANY,
  estimate_normal_z   ANY,
  estimate_corners_m  TEXT,           -- JSON [[x, y, z], ...]: top left, top right, bottom right,
                                      -- bottom left
  estimate_covariance_m2 TEXT,        -- JSON 3 x 3, of the centroid
  truth_x_m           ANY,            -- NULL in a scene without a target
  truth_y_m           ANY,
  truth_z_m           ANY,
  bound_covariance_m2 TEXT,           -- JSON 3 x 3, Cramér-Rao bound of the centroid
  stage_times_s       TEXT NOT NULL,  -- JSON {"rectify": 0.012, ...}
  PRIMARY KEY (cell, trial, detector)
) STRICT, WITHOUT ROWID;
)sql";

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
