#include "experiments/store_rows.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "experiments/record_json.h"

namespace fenestra {
namespace {

constexpr char kColumns[] =
    "cell, trial, detector, part, sensor, levels, drawn, outcome, reason, detail, "
    "estimate_x_m, estimate_y_m, estimate_z_m, "
    "estimate_normal_x, estimate_normal_y, estimate_normal_z, "
    "estimate_corners_m, estimate_covariance_m2, "
    "truth_x_m, truth_y_m, truth_z_m, bound_covariance_m2, stage_times_s";
constexpr int kColumnCount = 23;
constexpr char kErrorColumns[] =
    "centroid_error_x_mm, centroid_error_y_mm, centroid_error_z_mm, centroid_error_mm";
constexpr int kErrorColumnCount = 4;

void BindVector(SqliteStatement& insert, const std::optional<Eigen::Vector3d>& v) {
  for (int axis = 0; axis < 3; ++axis) {
    if (v) {
      insert.Bind((*v)[axis]);
    } else {
      insert.BindNull();
    }
  }
}

std::optional<Eigen::Vector3d> ReadVector(SqliteStatement& select) {
  const auto x = select.ReadNumber();
  const auto y = select.ReadNumber();
  const auto z = select.ReadNumber();
  if (!x || !y || !z) return std::nullopt;
  return Eigen::Vector3d(*x, *y, *z);
}

void BindMatrix(SqliteStatement& insert, const std::optional<Eigen::Matrix3d>& matrix) {
  if (matrix) {
    insert.Bind(MatrixToJson(*matrix));
  } else {
    insert.BindNull();
  }
}

std::optional<Eigen::Matrix3d> ReadMatrix(SqliteStatement& select) {
  const auto text = select.ReadOptionalText();
  return text ? std::optional(MatrixFromJson(*text)) : std::nullopt;
}

void BindEstimate(SqliteStatement& insert, const std::optional<WindowEstimate>& estimate) {
  if (!estimate) {
    for (int column = 0; column < 8; ++column) insert.BindNull();
    return;
  }
  BindVector(insert, estimate->p_CO);
  BindVector(insert, estimate->normal_C);
  insert.Bind(CornersToJson(estimate->p_CV));
  BindMatrix(insert, estimate->covariance_C);
}

std::optional<WindowEstimate> ReadEstimate(SqliteStatement& select) {
  const auto p_CO = ReadVector(select);
  const auto normal_C = ReadVector(select);
  const auto corners = select.ReadOptionalText();
  const auto covariance_C = ReadMatrix(select);
  if (!p_CO || !normal_C || !corners) return std::nullopt;
  WindowEstimate estimate;
  estimate.p_CO = *p_CO;
  estimate.p_CV = CornersFromJson(*corners);
  estimate.normal_C = *normal_C;
  estimate.covariance_C = covariance_C;
  return estimate;
}

SensorKind ParseSensor(const std::string& word) {
  for (const SensorKind sensor : {SensorKind::kStereo, SensorKind::kRgbd}) {
    if (word == ToString(sensor)) return sensor;
  }
  throw std::runtime_error("unknown sensor " + word);
}

int ReadIndex(SqliteStatement& select) {
  const int64_t index = select.ReadInteger();
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

SqliteStatement PrepareInsert(SqliteDatabase& database) {
  std::string marks = "?";
  for (int i = 1; i < kColumnCount + kErrorColumnCount; ++i) marks += ", ?";
  return database.Prepare(
      fmt::format("INSERT INTO trials ({}, {}) VALUES ({})", kColumns, kErrorColumns, marks));
}

void InsertRow(SqliteStatement& insert, const TrialRecord& record) {
  const Score& score = record.score;
  insert.Reset();
  insert.Bind(int64_t{record.cell}).Bind(int64_t{record.trial});
  insert.Bind(record.detector).Bind(record.part).Bind(ToString(record.sensor));
  insert.Bind(FactorsToJson(record.levels)).Bind(FactorsToJson(record.drawn));
  insert.Bind(ToString(score.outcome)).Bind(score.reason).Bind(score.detail);
  BindEstimate(insert, score.estimate);
  BindVector(insert, score.truth_p_CO);
  BindMatrix(insert, record.bound_C);
  insert.Bind(StageTimesToJson(record.stages));
  if (const auto error = score.CentroidError_C()) {
    BindVector(insert, Eigen::Vector3d(1e3 * *error));
    insert.Bind(1e3 * error->norm());
  } else {
    for (int column = 0; column < kErrorColumnCount; ++column) insert.BindNull();
  }
  insert.Run();
}

SqliteStatement PrepareSelect(SqliteDatabase& database, const std::string& condition) {
  return database.Prepare(
      fmt::format("SELECT {} FROM trials {} ORDER BY cell, trial, detector", kColumns, condition));
}

TrialRecord ReadRow(SqliteStatement& select) {
  TrialRecord record;
  record.cell = ReadIndex(select);
  record.trial = ReadIndex(select);
  record.detector = select.ReadText();
  record.part = select.ReadText();
  record.sensor = ParseSensor(select.ReadText());
  record.levels = FactorsFromJson(select.ReadText());
  record.drawn = FactorsFromJson(select.ReadText());
  const std::string outcome = select.ReadText();
  const auto parsed = ParseOutcome(outcome);
  if (!parsed) throw std::runtime_error("unknown outcome " + outcome);
  record.score.outcome = *parsed;
  record.score.reason = select.ReadText();
  record.score.detail = select.ReadText();
  record.score.estimate = ReadEstimate(select);
  record.score.truth_p_CO = ReadVector(select);
  RequireSense(record.score);
  record.bound_C = ReadMatrix(select);
  record.stages = StageTimesFromJson(select.ReadText());
  return record;
}

}  // namespace fenestra
