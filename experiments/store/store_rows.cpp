#include "experiments/store/store_rows.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/system/check.h"
#include "experiments/store/record_json.h"

namespace fenestra {
namespace {

constexpr char kColumns[] =
    "cell, trial, detector, part, sensor, levels, drawn, outcome, reason, detail, "
    "estimate_x_m, estimate_y_m, estimate_z_m, "
    "estimate_normal_x, estimate_normal_y, estimate_normal_z, "
    "estimate_corners_m, estimate_covariance_m2, "
    "truth_x_m, truth_y_m, truth_z_m, bound_covariance_m2, stage_times_s";
constexpr int kColumnCount = 23;
constexpr char kRunColumns[] = "shard, started_utc, ended_utc, jobs, host, processor, command";
constexpr char kErrorColumns[] =
    "centroid_error_x_mm, centroid_error_y_mm, centroid_error_z_mm, centroid_error_mm";
constexpr int kErrorColumnCount = 4;

// The parameters of a statement, in order.
class Parameters {
 public:
  explicit Parameters(SQLite::Statement& statement) : statement_(statement) {
    statement_.tryReset();  // What it returns is the error of the last step.
  }

  void Bind(int64_t value) { statement_.bind(next_++, value); }
  void Bind(double value) {
    FENESTRA_CHECK(!std::isnan(value), "SQLite would store NaN as NULL");
    statement_.bind(next_++, value);
  }
  void Bind(const std::string& value) { statement_.bind(next_++, value); }
  void Bind(const Eigen::Vector3d& v) {
    for (const double coordinate : v) Bind(coordinate);
  }
  void Bind(const Eigen::Matrix3d& matrix) { Bind(MatrixToJson(matrix)); }
  void BindNulls(int count) {
    for (int i = 0; i < count; ++i) statement_.bind(next_++);
  }
  template <typename Value>
  void Bind(const std::optional<Value>& value) {
    if (value) {
      Bind(*value);
    } else {
      BindNulls(std::is_same_v<Value, Eigen::Vector3d> ? 3 : 1);
    }
  }

 private:
  SQLite::Statement& statement_;
  int next_ = 1;
};

// The columns of the current row, in order.
class Columns {
 public:
  explicit Columns(const SQLite::Statement& select) : select_(select) {}

  int64_t Integer() { return Next().getInt64(); }
  std::string Text() { return Next().getString(); }
  std::optional<std::string> OptionalText() {
    const SQLite::Column column = Next();
    return column.isNull() ? std::nullopt : std::optional(column.getString());
  }
  std::optional<Eigen::Vector3d> Vector() {
    const std::array<SQLite::Column, 3> v = {Next(), Next(), Next()};
    if (v[0].isNull() || v[1].isNull() || v[2].isNull()) return std::nullopt;
    return Eigen::Vector3d(v[0].getDouble(), v[1].getDouble(), v[2].getDouble());
  }
  std::optional<Eigen::Matrix3d> Matrix() {
    const auto text = OptionalText();
    return text ? std::optional(MatrixFromJson(*text)) : std::nullopt;
  }

 private:
  SQLite::Column Next() { return select_.getColumn(next_++); }

  const SQLite::Statement& select_;
  int next_ = 0;
};

void BindEstimate(Parameters& insert, const std::optional<WindowEstimate>& estimate) {
  if (!estimate) {
    insert.BindNulls(8);
    return;
  }
  insert.Bind(estimate->p_CO);
  insert.Bind(estimate->normal_C);
  insert.Bind(CornersToJson(estimate->p_CV));
  insert.Bind(estimate->covariance_C);
}

std::optional<WindowEstimate> ReadEstimate(Columns& row) {
  const auto p_CO = row.Vector();
  const auto normal_C = row.Vector();
  const auto corners = row.OptionalText();
  const auto covariance_C = row.Matrix();
  if (!p_CO || !normal_C || !corners) return std::nullopt;
  WindowEstimate estimate;
  estimate.p_CO = *p_CO;
  estimate.p_CV = CornersFromJson(*corners);
  estimate.normal_C = *normal_C;
  estimate.covariance_C = covariance_C;
  return estimate;
}

SensorKind ReadSensor(Columns& row) {
  const std::string word = row.Text();
  const auto sensor = ParseSensorKind(word);
  if (!sensor) throw std::runtime_error("unknown sensor " + word);
  return *sensor;
}

int ReadIndex(Columns& row) {
  const int64_t index = row.Integer();
  if (index < 0 || index > std::numeric_limits<int>::max()) {
    throw std::runtime_error(fmt::format("cell or trial {}", index));
  }
  return static_cast<int>(index);
}

// Checks what everything that works with rows relies on.
void RequireSense(const Score& score) {
  const bool finite = (!score.estimate || score.estimate->p_CO.allFinite()) &&
                      (!score.truth_p_CO || score.truth_p_CO->allFinite());
  if (!finite) throw std::runtime_error("a place that is not finite");
  const bool found = score.outcome == Outcome::kHit || score.outcome == Outcome::kGross;
  if (found && !score.CentroidError_C()) throw std::runtime_error("a hit without its error");
}

}  // namespace

SQLite::Statement PrepareInsert(const SQLite::Database& database) {
  std::string marks = "?";
  for (int i = 1; i < kColumnCount + kErrorColumnCount; ++i) marks += ", ?";
  return SQLite::Statement(database, fmt::format("INSERT INTO trials ({}, {}) VALUES ({})",
                                                 kColumns, kErrorColumns, marks));
}

void InsertRow(SQLite::Statement& statement, const TrialRecord& record) {
  const Score& score = record.score;
  Parameters insert(statement);
  insert.Bind(int64_t{record.cell});
  insert.Bind(int64_t{record.trial});
  insert.Bind(record.detector);
  insert.Bind(record.part);
  insert.Bind(ToString(record.sensor));
  insert.Bind(FactorsToJson(record.levels));
  insert.Bind(FactorsToJson(record.drawn));
  insert.Bind(ToString(score.outcome));
  insert.Bind(score.reason);
  insert.Bind(score.detail);
  BindEstimate(insert, score.estimate);
  insert.Bind(score.truth_p_CO);
  insert.Bind(record.bound_C);
  insert.Bind(StageTimesToJson(record.stages));
  if (const auto error = score.CentroidError_C()) {
    insert.Bind(Eigen::Vector3d(1e3 * *error));
    insert.Bind(1e3 * error->norm());
  } else {
    insert.BindNulls(kErrorColumnCount);
  }
  statement.exec();
}

SQLite::Statement PrepareSelect(const SQLite::Database& database, const std::string& condition) {
  return SQLite::Statement(
      database,
      fmt::format("SELECT {} FROM trials {} ORDER BY cell, trial, detector", kColumns, condition));
}

TrialRecord ReadRow(const SQLite::Statement& select) {
  Columns row(select);
  TrialRecord record;
  record.cell = ReadIndex(row);
  record.trial = ReadIndex(row);
  record.detector = row.Text();
  record.part = row.Text();
  record.sensor = ReadSensor(row);
  record.levels = FactorsFromJson(row.Text());
  record.drawn = FactorsFromJson(row.Text());
  const std::string outcome = row.Text();
  const auto parsed = ParseOutcome(outcome);
  if (!parsed) throw std::runtime_error("unknown outcome " + outcome);
  record.score.outcome = *parsed;
  record.score.reason = row.Text();
  record.score.detail = row.Text();
  record.score.estimate = ReadEstimate(row);
  record.score.truth_p_CO = row.Vector();
  RequireSense(record.score);
  record.bound_C = row.Matrix();
  record.stages = StageTimesFromJson(row.Text());
  return record;
}

SQLite::Statement PrepareInsertRun(const SQLite::Database& database) {
  return SQLite::Statement(
      database, fmt::format("INSERT INTO runs ({}) VALUES (?, ?, ?, ?, ?, ?, ?)", kRunColumns));
}

void InsertRun(SQLite::Statement& statement, const RunEntry& run) {
  Parameters insert(statement);
  insert.Bind(run.shard);
  insert.Bind(run.started_utc);
  insert.Bind(run.ended_utc);
  insert.Bind(int64_t{run.jobs});
  insert.Bind(run.host);
  insert.Bind(run.processor);
  insert.Bind(run.command);
  statement.exec();
}

SQLite::Statement PrepareSelectRuns(const SQLite::Database& database) {
  return SQLite::Statement(database, fmt::format("SELECT {} FROM runs ORDER BY run", kRunColumns));
}

RunEntry ReadRun(const SQLite::Statement& select) {
  Columns row(select);
  RunEntry run;
  run.shard = row.Text();
  run.started_utc = row.Text();
  run.ended_utc = row.OptionalText();
  run.jobs = static_cast<int>(row.Integer());
  run.host = row.Text();
  run.processor = row.Text();
  run.command = row.Text();
  return run;
}

}  // namespace fenestra
