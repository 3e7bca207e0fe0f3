#include <fmt/format.h>

#include "experiments/number_format.h"
#include "experiments/report.h"
#include "experiments/report_section.h"

namespace fenestra {
namespace {

TextTable TableOf(const ReportSection& section) {
  TextTable table;
  AddKeyColumns(section, table);
  if (section.has_attempts) {
    for (const char* heading : {"n", "hit", "gross", "wrong", "missed"}) table.AddColumn(heading);
  }
  if (section.has_empty_scenes) {
    for (const char* heading : {"empty", "alarms", "clear"}) table.AddColumn(heading);
  }
  table.AddColumn("crashed");
  if (section.has_attempts) {
    for (const char* heading : {"out", "bias z", "RMSE z", "RMSE xy", "P95"}) {
      table.AddColumn(heading);
    }
  }
  table.AddColumn("time");
  return table;
}

std::vector<std::string> Row(const ReportSection& section, const CellSummary& row) {
  std::vector<std::string> cells = KeyCells(section, row);
  const auto add_count = [&](int count) { cells.push_back(std::to_string(count)); };
  const auto add_mm = [&](std::optional<double> value_m) {
    cells.push_back(Significant(ToMilli(value_m)));
  };
  if (section.has_attempts) {
    add_count(row.in_view);
    for (const Outcome outcome :
         {Outcome::kHit, Outcome::kGross, Outcome::kWrongWindow, Outcome::kMissed}) {
      add_count(row.counts[outcome]);
    }
  }
  if (section.has_empty_scenes) {
    add_count(row.without_target);
    add_count(row.counts[Outcome::kFalseAlarm]);
    add_count(row.counts[Outcome::kClear]);
  }
  add_count(row.counts[Outcome::kCrashed]);
  if (section.has_attempts) {
    add_count(row.counts[Outcome::kOutOfView]);
    const auto& errors = row.hit_errors;
    add_mm(errors ? std::optional(errors->bias.z()) : std::nullopt);
    add_mm(errors ? std::optional(errors->rmse_depth) : std::nullopt);
    add_mm(errors ? std::optional(errors->rmse_across) : std::nullopt);
    add_mm(row.p95_error_m);
  }
  cells.push_back(Significant(ToMilli(row.median_total_s)));
  return cells;
}

constexpr char kAttemptLegend[] =
    "n: attempts, the target wholly in view = hit + gross + wrong + missed + crashed; out: not\n"
    "attempted, the target not wholly in view. Lengths in mm: bias and RMSE over the hits, P95 of\n"
    "the 3-D centroid error over all n, where an attempt without an estimate counts as inf.\n";
constexpr char kEmptySceneLegend[] =
    "empty: scenes without a window = alarms (a window reported) + clear + crashed there.\n";
constexpr char kTimeLegend[] = "time: median of the detector's total in ms. —: no such figure.\n";

}  // namespace

std::string SummaryForTerminal(std::span<const CellSummary> summaries) {
  std::string text;
  bool attempts = false;
  bool empty_scenes = false;
  for (const ReportSection& section : MakeSections(summaries)) {
    TextTable table = TableOf(section);
    for (const CellSummary* row : section.rows) table.AddRow(Row(section, *row));
    text += Heading(section) + "\n" + table.ToPlainText() + "\n";
    attempts |= section.has_attempts;
    empty_scenes |= section.has_empty_scenes;
  }
  if (text.empty()) return "no trials\n";
  if (attempts) text += kAttemptLegend;
  if (empty_scenes) text += kEmptySceneLegend;
  return text + kTimeLegend;
}

}  // namespace fenestra
