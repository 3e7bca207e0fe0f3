#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/number_format.h"
#include "experiments/report/report.h"
#include "experiments/report/report_section.h"

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
  table.AddColumn("crash");
  if (section.has_attempts) {
    for (const char* heading : {"out", "bias x", "bias y", "bias z", "RMSE xy", "RMSE z"}) {
      table.AddColumn(heading);
    }
    if (section.has_bounds) {
      table.AddColumn("z/b");
      table.AddColumn("3D/b");
    }
    table.AddColumn("P95");
  }
  table.AddColumn("time");
  return table;
}

std::vector<std::string> Row(const ReportSection& section, const CellSummary& row) {
  std::vector<std::string> cells = KeyCells(section, row);
  const auto add_count = [&](int count) { cells.push_back(std::to_string(count)); };
  const auto add_metric = [&](const char* name) { cells.push_back(Significant(row.Value(name))); };
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
    for (const char* metric :
         {"bias_x_mm", "bias_y_mm", "bias_z_mm", "rmse_across_mm", "rmse_depth_mm"}) {
      add_metric(metric);
    }
    if (section.has_bounds) {
      add_metric("rmse_depth_over_bound");
      add_metric("rmse_over_bound");
    }
    add_metric("p95_error_mm");
  }
  add_metric("p50_time_ms");
  return cells;
}

// "paper-stereo by stage [ms]: rectify 4.23, match 46.7, ..., of 61.2 (the paper: 200)": medians
// over the cells of their medians.
std::string StageLine(const ReportSection& section, const std::string& detector) {
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  std::vector<double> totals;
  for (const CellSummary* row : section.rows) {
    const auto total_ms = row->Value("p50_time_ms");
    if (row->detector != detector || !total_ms) continue;
    if (section.has_attempts && row->counts[Outcome::kHit] == 0) continue;
    totals.push_back(*total_ms);
    for (const StageMedian& median : row->stage_medians) {
      const auto same = [&median](const auto& stage) { return stage.first == median.stage; };
      auto found = std::find_if(stages.begin(), stages.end(), same);
      if (found == stages.end()) found = stages.insert(found, {median.stage, {}});
      found->second.push_back(median.median_s);
    }
  }
  if (totals.empty()) return "";
  std::string text = detector + " by stage [ms]: ";
  for (const auto& [stage, medians] : stages) {
    text += fmt::format("{} {}, ", stage, Significant(1e3 * SampleQuantile(medians, 0.5)));
  }
  return text + fmt::format("of {} (the paper: {})\n", Significant(SampleQuantile(totals, 0.5)),
                            Significant(PaperMilliseconds(section.sensor)));
}

constexpr char kAttemptLegend[] =
    "n: attempts, the target wholly in view = hit + gross + wrong + missed + crash(ed); out: not\n"
    "attempted, the target not wholly in view. Lengths in mm; x to the right, y down, z in depth: "
    "bias\n"
    "and RMSE over the hits, P95 of the 3-D error over all n, an attempt without estimate as "
    "inf.\n";
constexpr char kBoundLegend[] =
    "z/b, 3D/b: RMSE of z and of all three over Cramér and Rao's bound for the same hits "
    "(docs/theory.md).\n";
constexpr char kEmptySceneLegend[] =
    "empty: scenes without a window = alarms (a window reported) + clear + crash(ed) there.\n";
constexpr char kTimeLegend[] =
    "time: median of the detector's total in ms, and by stage the median over the cells with hits "
    "of\n"
    "their medians. —: no such figure.\n";

}  // namespace

std::string SummaryForTerminal(std::span<const CellSummary> summaries) {
  std::string text;
  bool attempts = false;
  bool empty_scenes = false;
  bool bounds = false;
  for (const ReportSection& section : MakeSections(summaries)) {
    TextTable table = TableOf(section);
    for (const CellSummary* row : section.rows) table.AddRow(Row(section, *row));
    text += Heading(section) + "\n" + table.ToPlainText();
    for (const std::string& detector : section.detectors) text += StageLine(section, detector);
    text += "\n";
    attempts |= section.has_attempts;
    empty_scenes |= section.has_empty_scenes;
    bounds |= section.has_bounds;
  }
  if (text.empty()) return "no trials\n";
  if (attempts) text += kAttemptLegend;
  if (bounds) text += kBoundLegend;
  if (empty_scenes) text += kEmptySceneLegend;
  return text + kTimeLegend;
}

}  // namespace fenestra
