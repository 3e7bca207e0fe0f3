#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/number_format.h"
#include "experiments/report/report.h"
#include "experiments/report/report_section.h"

namespace fenestra {
namespace {

std::string Millimetres(std::optional<double> value_m) {
  return Significant(ToMilli(value_m));
}

int Sum(const ReportSection& section, const std::string& detector, auto count) {
  int sum = 0;
  for (const CellSummary* row : section.rows) {
    if (row->detector == detector) sum += count(*row);
  }
  return sum;
}

/// "- **near** (rgbd, paper-rgbd): 38 of 40 attempts hit (95.0 %)".
std::string HeadlineItem(const ReportSection& section, const std::string& detector) {
  const auto total = [&](auto count) { return Sum(section, detector, count); };
  std::string text =
      fmt::format("- **{}** ({}, {}): ", section.part, ToString(section.sensor), detector);
  if (section.has_attempts) {
    const int hits = total([](const CellSummary& row) { return row.hits.count; });
    const int attempts = total([](const CellSummary& row) { return row.in_view; });
    text += fmt::format("{} of {} attempts hit", hits, attempts);
    if (attempts > 0) text += fmt::format(" ({})", Percent(static_cast<double>(hits) / attempts));
    text += section.has_empty_scenes ? "; " : "";
  }
  if (section.has_empty_scenes) {
    text += fmt::format("{} of {} scenes without a window gave a false alarm",
                        total([](const CellSummary& row) { return row.false_alarms.count; }),
                        total([](const CellSummary& row) { return row.without_target; }));
  }
  return text + "\n";
}

std::string OutcomeTable(const ReportSection& section) {
  TextTable table;
  AddKeyColumns(section, table);
  for (const char* heading : {"in view", "hit", "gross", "wrong window", "missed", "crashed",
                              "hit rate", "95 % interval", "out of view"}) {
    table.AddColumn(heading);
  }
  for (const CellSummary* row : section.rows) {
    if (row->in_view + row->counts[Outcome::kOutOfView] == 0) continue;
    std::vector<std::string> cells = KeyCells(section, *row);
    cells.push_back(std::to_string(row->in_view));
    for (const Outcome outcome : {Outcome::kHit, Outcome::kGross, Outcome::kWrongWindow,
                                  Outcome::kMissed, Outcome::kCrashed}) {
      cells.push_back(std::to_string(row->counts[outcome]));
    }
    cells.push_back(row->in_view > 0 ? Percent(row->hits.rate()) : kAbsent);
    cells.push_back(row->in_view > 0 ? Percent(row->hits.interval95) : kAbsent);
    cells.push_back(std::to_string(row->counts[Outcome::kOutOfView]));
    table.AddRow(std::move(cells));
  }
  return "### Outcomes\n\n" + table.ToMarkdown() + "\n";
}

std::string FalseAlarmTable(const ReportSection& section) {
  TextTable table;
  AddKeyColumns(section, table);
  for (const char* heading :
       {"scenes", "false alarm", "clear", "crashed", "false alarm rate", "95 % interval"}) {
    table.AddColumn(heading);
  }
  for (const CellSummary* row : section.rows) {
    if (row->without_target == 0) continue;
    std::vector<std::string> cells = KeyCells(section, *row);
    const int alarms = row->counts[Outcome::kFalseAlarm];
    const int clear = row->counts[Outcome::kClear];
    for (const int count :
         {row->without_target, alarms, clear, row->without_target - alarms - clear}) {
      cells.push_back(std::to_string(count));
    }
    cells.push_back(Percent(row->false_alarms.rate()));
    cells.push_back(Percent(row->false_alarms.interval95));
    table.AddRow(std::move(cells));
  }
  return "### Scenes without a window\n\n" + table.ToMarkdown() + "\n";
}

std::string ErrorTable(const ReportSection& section) {
  TextTable table;
  AddKeyColumns(section, table);
  for (const char* heading :
       {"hits", "bias x", "bias y", "bias z", "RMSE", "RMSE depth", "RMSE across"}) {
    table.AddColumn(heading);
  }
  if (section.has_bounds) {
    table.AddColumn("RMSE / bound");
    table.AddColumn("depth / bound");
  }
  for (const char* heading : {"in view", "P50", "P95"}) table.AddColumn(heading);
  for (const CellSummary* row : section.rows) {
    if (row->in_view == 0) continue;
    std::vector<std::string> cells = KeyCells(section, *row);
    cells.push_back(std::to_string(row->hits.count));
    const auto& errors = row->hit_errors;
    for (int axis = 0; axis < 3; ++axis) {
      std::optional<double> standard_error_m;
      if (errors && errors->bias_standard_error) {
        standard_error_m = (*errors->bias_standard_error)[axis];
      }
      cells.push_back(errors
                          ? WithStandardError(1e3 * errors->bias[axis], ToMilli(standard_error_m))
                          : kAbsent);
    }
    for (const auto rmse : {&HitErrors::rmse, &HitErrors::rmse_depth, &HitErrors::rmse_across}) {
      cells.push_back(Millimetres(errors ? std::optional((*errors).*rmse) : std::nullopt));
    }
    if (section.has_bounds) {
      cells.push_back(Significant(errors ? errors->OverBound() : std::nullopt));
      cells.push_back(Significant(errors ? errors->DepthOverBound() : std::nullopt));
    }
    cells.push_back(std::to_string(row->in_view));
    cells.push_back(Millimetres(row->p50_error_m));
    cells.push_back(Millimetres(row->p95_error_m));
    table.AddRow(std::move(cells));
  }
  if (table.empty()) return "";
  return "### Centroid errors [mm]\n\n" + table.ToMarkdown() + "\n";
}

std::string ReasonTable(const ReportSection& section) {
  TextTable table;
  AddKeyColumns(section, table);
  table.AddColumn("outcome", TextTable::Align::kLeft);
  table.AddColumn("reason", TextTable::Align::kLeft);
  table.AddColumn("trials");
  for (const CellSummary* row : section.rows) {
    for (const ReasonCount& reason : row->reasons) {
      std::vector<std::string> cells = KeyCells(section, *row);
      cells.push_back(ToString(reason.outcome));
      cells.push_back(reason.reason);
      cells.push_back(fmt::format("{} of {}", reason.count, row->trials));
      table.AddRow(std::move(cells));
    }
  }
  if (table.empty()) return "";
  return "### Reasons of the trials without an estimate\n\n" + table.ToMarkdown() + "\n";
}

std::string TimeTable(const ReportSection& section, const std::string& detector) {
  std::vector<std::string> stages;
  for (const CellSummary* row : section.rows) {
    if (row->detector != detector) continue;
    for (const StageMedian& stage : row->stage_medians) {
      if (std::find(stages.begin(), stages.end(), stage.stage) == stages.end()) {
        stages.push_back(stage.stage);
      }
    }
  }
  TextTable table;
  for (const std::string& name : section.varying) table.AddColumn(name);
  table.AddColumn("trials");
  for (const std::string& stage : stages) table.AddColumn(stage);
  table.AddColumn("total");
  table.AddColumn("paper");
  for (const CellSummary* row : section.rows) {
    if (row->detector != detector || row->timed == 0) continue;
    std::vector<std::string> cells;
    for (const std::string& name : section.varying) cells.push_back(LevelText(row->levels, name));
    cells.push_back(std::to_string(row->timed));
    for (const std::string& stage : stages) {
      const auto found = std::find_if(row->stage_medians.begin(), row->stage_medians.end(),
                                      [&](const auto& median) { return median.stage == stage; });
      const bool has = found != row->stage_medians.end();
      cells.push_back(Significant(has ? std::optional(1e3 * found->median_s) : std::nullopt));
    }
    cells.push_back(Significant(ToMilli(row->median_total_s)));
    cells.push_back(Significant(PaperMilliseconds(section.sensor)));
    table.AddRow(std::move(cells));
  }
  if (table.empty()) return "";
  return fmt::format("### Median time of {} [ms]\n\n{}\n", detector, table.ToMarkdown());
}

std::string Section(const ReportSection& section) {
  std::string text = "## " + Heading(section) + "\n\n";
  if (section.has_attempts) text += OutcomeTable(section) + ErrorTable(section);
  if (section.has_empty_scenes) text += FalseAlarmTable(section);
  text += ReasonTable(section);
  for (const std::string& detector : section.detectors) text += TimeTable(section, detector);
  return text;
}

std::string HowToRead() {
  std::string text = "## How to read the tables\n\n";
  for (const Outcome outcome : kAllOutcomes) {
    text += fmt::format("- `{}`: {}.\n", ToString(outcome), OutcomeDefinition(outcome));
  }
  return text + R"md(
The denominators: *in view* are the attempts, all trials with the target wholly in view; they are
the sum of `hit`, `gross`, `wrong_window`, `missed` and `crashed`. *scenes* are the trials without a
window; they are the sum of `false_alarm`, `clear` and the crashes among them. The 95 % intervals of
rates are Clopper–Pearson's.

*bias* is the mean over the hits of estimate minus truth, ± its standard error, in the frame of the
scored camera: x to the right, y down, z in depth. *RMSE* is over the hits, too: √(mean of
x² + y² + z²), *depth* √(mean of z²), *across* √(mean of x² + y²). */ bound* is the RMSE as a multiple
of Cramér and Rao's bound for the same hits, each where it stands: what an unbiased estimate that
knows what the detector knows could reach (docs/theory.md). *P50* and *P95* are quantiles of
the three-dimensional error over all attempts, where one without an estimate counts as infinite:
`inf` in P95 says that more than 5 % of the attempts gave no estimate, however small the RMSE of the
others. — stands where there is no such figure.

Times are medians over the trials that did not crash, stage by stage (so they need not add up), on
the machine named below; *paper* is the total that the paper of 2013 states for its own machine.
)md";
}

std::string Provenance(const ReportTitle& title) {
  if (title.provenance.empty()) return "";
  TextTable table;
  table.AddColumn("what", TextTable::Align::kLeft);
  table.AddColumn("value", TextTable::Align::kLeft);
  for (const auto& [name, value] : title.provenance) table.AddRow({name, value});
  return "\n## Where the figures come from\n\n" + table.ToMarkdown();
}

}  // namespace

std::string SummaryMarkdown(const ReportTitle& title, std::span<const CellSummary> summaries) {
  std::string text = fmt::format("# {}\n\n", title.study);
  if (!title.description.empty()) text += title.description + "\n\n";
  const std::vector<ReportSection> sections = MakeSections(summaries);
  if (sections.empty()) text += "No trials.\n";
  for (const ReportSection& section : sections) {
    for (const std::string& detector : section.detectors) text += HeadlineItem(section, detector);
  }
  text += "\n";
  for (const ReportSection& section : sections) text += Section(section);
  return text + HowToRead() + Provenance(title);
}

}  // namespace fenestra
