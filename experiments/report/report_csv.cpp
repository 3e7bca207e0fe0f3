#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <span>
#include <sstream>

#include "experiments/output/file_formats.h"
#include "experiments/output/number_format.h"
#include "experiments/report/report.h"
#include "experiments/report/report_section.h"

namespace fenestra {
namespace {

using Names = std::vector<std::string>;

// The columns that depend on the rows, in the order in which they first occur. A factor may be a
// level in one part and drawn in another: it has one column all the same.
struct RowColumns {
  Names factors;
  Names stages;

  void AppendNewOf(const TrialRecord& record) {
    for (const auto& factor : record.levels) AppendNew(factor.first, factors);
    for (const auto& factor : record.drawn) AppendNew(factor.first, factors);
    for (const StageTime& stage : record.stages) AppendNew(stage.stage, stages);
  }
};

Names TimeColumns(const std::string& total, const Names& stages) {
  Names columns = {total};
  for (const std::string& stage : stages) columns.push_back(fmt::format("time_{}_ms", stage));
  return columns;
}

Names EstimateColumns() {
  Names names = {"centroid_error_x_mm", "centroid_error_y_mm", "centroid_error_z_mm",
                 "centroid_error_mm",   "estimate_x_m",        "estimate_y_m",
                 "estimate_z_m",        "estimate_normal_x",   "estimate_normal_y",
                 "estimate_normal_z"};
  for (const char* corner : {"top_left", "top_right", "bottom_right", "bottom_left"}) {
    for (const char axis : {'x', 'y', 'z'}) {
      names.push_back(fmt::format("estimate_{}_{}_m", corner, axis));
    }
  }
  return names;
}

void AddVector(const std::optional<Eigen::Vector3d>& v, CsvWriter& csv) {
  for (int axis = 0; axis < 3; ++axis) csv.Add(v ? std::optional((*v)[axis]) : std::nullopt);
}

void AddTrialHeader(const RowColumns& columns, CsvWriter& csv) {
  csv.AddAll({"part", "sensor", "cell", "trial", "detector"}).AddAll(columns.factors);
  csv.AddAll({"outcome", "reason", "detail"}).AddAll(EstimateColumns());
  csv.AddAll({"truth_x_m", "truth_y_m", "truth_z_m"});
  csv.AddAll({"bound_x_mm", "bound_y_mm", "bound_z_mm"});
  csv.AddAll(TimeColumns("time_total_ms", columns.stages)).EndLine();
}

void AddScore(const Score& score, CsvWriter& csv) {
  csv.Add(ToString(score.outcome)).Add(score.reason).Add(score.detail);
  std::optional<Eigen::Vector3d> error_mm = score.CentroidError_C();
  if (error_mm) *error_mm *= 1e3;
  AddVector(error_mm, csv);
  csv.Add(error_mm ? std::optional(error_mm->norm()) : std::nullopt);
  const auto& estimate = score.estimate;
  AddVector(estimate ? std::optional(estimate->p_CO) : std::nullopt, csv);
  AddVector(estimate ? std::optional(estimate->normal_C) : std::nullopt, csv);
  for (size_t i = 0; i < 4; ++i) {
    AddVector(estimate ? std::optional(estimate->p_CV[i]) : std::nullopt, csv);
  }
  AddVector(score.truth_p_CO, csv);
}

std::optional<Eigen::Vector3d> BoundOf_mm(const TrialRecord& record) {
  if (!record.bound_C) return std::nullopt;
  return Eigen::Vector3d(1e3 * record.bound_C->diagonal().cwiseSqrt());
}

std::optional<double> SecondsOf(const TrialRecord& record, const std::string& name) {
  for (const StageTime& stage : record.stages) {
    if (stage.stage == name) return stage.seconds;
  }
  return std::nullopt;
}

const StageMedian* StageOf(const CellSummary& summary, const std::string& name) {
  for (const StageMedian& stage : summary.stage_medians) {
    if (stage.stage == name) return &stage;
  }
  return nullptr;
}

constexpr const char* kLower = "_lower95";
constexpr const char* kUpper = "_upper95";

// Metrics in columns that summary.csv has had from its first version on, in their order.
constexpr const char* kFirstRates[] = {"hit_rate", "false_alarm_rate"};
constexpr const char* kFirstErrors[] = {"rmse_mm", "rmse_depth_mm", "rmse_across_mm"};
constexpr const char* kFirstRatios[] = {"rmse_over_bound", "rmse_depth_over_bound", "p50_error_mm",
                                        "p95_error_mm"};
constexpr const char* kBiases[] = {"bias_x_mm", "bias_y_mm", "bias_z_mm"};
constexpr const char* kMedianTime = "p50_time_ms";

bool IsOneOf(const std::string& name, std::initializer_list<std::span<const char* const>> groups) {
  return std::any_of(groups.begin(), groups.end(), [&name](const auto& group) {
    return std::find(group.begin(), group.end(), name) != group.end();
  });
}

// Those whose value has a column of its own further on, and those that only lack the ends.
bool HasValueBefore(const std::string& name) {
  return IsOneOf(name, {kFirstRates, kFirstErrors, kFirstRatios, kBiases});
}
bool HasEndsBefore(const std::string& name) {
  return IsOneOf(name, {kFirstRates}) || name == kMedianTime;
}

void AddSummaryHeader(const Names& levels, const Names& stages, CsvWriter& csv) {
  csv.AddAll({"part", "sensor", "cell", "detector"}).AddAll(levels);
  csv.AddAll({"trials", "in_view", "without_target"});
  for (const Outcome outcome : kAllOutcomes) csv.Add(ToString(outcome));
  for (const std::string rate : kFirstRates) {
    csv.AddAll({rate, ColumnOf(rate, kLower), ColumnOf(rate, kUpper)});
  }
  for (const char* bias : kBiases) csv.Add(bias);
  csv.AddAll({"bias_standard_error_x_mm", "bias_standard_error_y_mm", "bias_standard_error_z_mm"});
  for (const char* error : kFirstErrors) csv.Add(error);
  csv.AddAll({"bound_mm", "bound_depth_mm", "bound_across_mm"});
  for (const char* ratio : kFirstRatios) csv.Add(ratio);
  csv.AddAll({"reasons", "timed"});
  for (const NamedMetric& metric : Metrics()) {
    if (HasEndsBefore(metric.name)) continue;
    if (!HasValueBefore(metric.name)) csv.Add(metric.name);
    csv.AddAll({ColumnOf(metric.name, kLower), ColumnOf(metric.name, kUpper)});
  }
  csv.AddAll({"time_total_median_lower95_ms", "time_total_median_upper95_ms"});
  for (const std::string& stage : stages) {
    csv.AddAll(
        {fmt::format("time_{}_lower95_ms", stage), fmt::format("time_{}_upper95_ms", stage)});
  }
  csv.AddAll(TimeColumns("time_total_median_ms", stages)).EndLine();
}

void AddEnds(const MetricEstimate* estimate, CsvWriter& csv) {
  const bool has = estimate != nullptr && estimate->interval;
  csv.Add(has ? std::optional(estimate->interval->lower) : std::nullopt);
  csv.Add(has ? std::optional(estimate->interval->upper) : std::nullopt);
}

void AddStandardErrors(const CellSummary& row, CsvWriter& csv) {
  for (const char* bias : kBiases) {
    const MetricEstimate* estimate = row.Find(bias);
    csv.Add(estimate != nullptr ? estimate->standard_error : std::nullopt);
  }
}

void AddMetrics(const CellSummary& row, CsvWriter& csv) {
  for (const char* rate : kFirstRates) {
    csv.Add(row.Value(rate));
    AddEnds(row.Find(rate), csv);
  }
  for (const char* bias : kBiases) csv.Add(row.Value(bias));
  AddStandardErrors(row, csv);
  for (const char* error : kFirstErrors) csv.Add(row.Value(error));
  for (const auto bound : {&ErrorBounds::all, &ErrorBounds::depth, &ErrorBounds::across}) {
    csv.Add(ToMilli(row.bounds ? std::optional((*row.bounds).*bound) : std::nullopt));
  }
  for (const char* ratio : kFirstRatios) csv.Add(row.Value(ratio));
}

void AddFurtherMetrics(const CellSummary& row, const Names& stages, CsvWriter& csv) {
  for (const NamedMetric& metric : Metrics()) {
    if (HasEndsBefore(metric.name)) continue;
    if (!HasValueBefore(metric.name)) csv.Add(row.Value(metric.name));
    AddEnds(row.Find(metric.name), csv);
  }
  AddEnds(row.Find(kMedianTime), csv);
  for (const std::string& name : stages) {
    const StageMedian* stage = StageOf(row, name);
    for (const auto end : {&Interval::lower, &Interval::upper}) {
      csv.Add(ToMilli(stage != nullptr ? std::optional(stage->interval_s.*end) : std::nullopt));
    }
  }
}

/// "missed/no_contour: 3; crashed/exception: 1".
std::string ReasonText(const std::vector<ReasonCount>& reasons) {
  std::string text;
  for (const ReasonCount& reason : reasons) {
    if (!text.empty()) text += "; ";
    text += fmt::format("{}/{}: {}", ToString(reason.outcome), reason.reason, reason.count);
  }
  return text;
}

void AddTrialLine(const TrialRecord& record, const RowColumns& columns, CsvWriter& csv) {
  csv.Add(record.part).Add(ToString(record.sensor)).Add(record.cell).Add(record.trial);
  csv.Add(record.detector);
  FactorValues values = record.levels;
  values.insert(values.end(), record.drawn.begin(), record.drawn.end());
  for (const std::string& factor : columns.factors) csv.Add(LevelText(values, factor));
  AddScore(record.score, csv);
  AddVector(BoundOf_mm(record), csv);
  csv.Add(ToMilli(record.TotalSeconds()));
  for (const std::string& stage : columns.stages) csv.Add(ToMilli(SecondsOf(record, stage)));
  csv.EndLine();
}

}  // namespace

void WriteTrialsCsv(const RowPass& for_each_row, std::ostream& out) {
  RowColumns columns;
  for_each_row([&](const TrialRecord& record) { columns.AppendNewOf(record); });
  CsvWriter csv;
  AddTrialHeader(columns, csv);
  for_each_row([&](const TrialRecord& record) {
    AddTrialLine(record, columns, csv);
    out << csv.TakeText();
  });
  out << csv.TakeText();  // The header, if there are no rows.
}

std::string TrialsCsv(std::span<const TrialRecord> records) {
  std::ostringstream out;
  WriteTrialsCsv(
      [records](const auto& visit) {
        for (const TrialRecord& record : records) visit(record);
      },
      out);
  return out.str();
}

std::string IntervalsCsv(std::span<const CellSummary> summaries) {
  CsvWriter csv;
  csv.AddAll({"part", "sensor", "cell", "detector", "levels", "figure", "value", "of", "lower",
              "upper", "confidence", "method", "clusters"});
  csv.EndLine();
  for (const CellSummary& row : summaries) {
    for (const auto& [name, estimate] : row.metrics) {
      csv.Add(row.part).Add(ToString(row.sensor)).Add(row.cell).Add(row.detector);
      csv.Add(LevelsText(row.levels)).Add(name).Add(estimate.value).Add(estimate.of);
      AddEnds(&estimate, csv);
      csv.Add(row.confidence).Add(estimate.method).Add(estimate.clusters).EndLine();
    }
  }
  return csv.text();
}

std::string SummaryCsv(std::span<const CellSummary> summaries) {
  Names levels;
  Names stages;
  for (const CellSummary& row : summaries) {
    for (const auto& level : row.levels) AppendNew(level.first, levels);
    for (const StageMedian& stage : row.stage_medians) AppendNew(stage.stage, stages);
  }
  CsvWriter csv;
  AddSummaryHeader(levels, stages, csv);
  for (const CellSummary& row : summaries) {
    csv.Add(row.part).Add(ToString(row.sensor)).Add(row.cell).Add(row.detector);
    for (const std::string& level : levels) csv.Add(LevelText(row.levels, level));
    csv.Add(row.trials).Add(row.in_view).Add(row.without_target);
    for (const Outcome outcome : kAllOutcomes) csv.Add(row.counts[outcome]);
    AddMetrics(row, csv);
    csv.Add(ReasonText(row.reasons)).Add(row.timed);
    AddFurtherMetrics(row, stages, csv);
    csv.Add(row.Value(kMedianTime));
    for (const std::string& name : stages) {
      const StageMedian* stage = StageOf(row, name);
      csv.Add(ToMilli(stage != nullptr ? std::optional(stage->median_s) : std::nullopt));
    }
    csv.EndLine();
  }
  return csv.text();
}

}  // namespace fenestra
