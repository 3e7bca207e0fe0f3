#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/number_format.h"
#include "experiments/report/report.h"
#include "experiments/report/report_section.h"

namespace fenestra {
namespace {

// "12.3 (11.9 to 12.7)", the value and the ends of its interval.
std::string WithInterval(double value, const std::optional<Interval>& interval) {
  if (!interval) return Significant(value);
  return fmt::format("{} ({} to {})", Significant(value), Significant(interval->lower),
                     Significant(interval->upper));
}

std::string WithInterval(const MetricEstimate* estimate) {
  return estimate == nullptr ? kAbsent : WithInterval(estimate->value, estimate->interval);
}

// "95.0 % (90.0–97.9 %)".
std::string ShareWithInterval(const MetricEstimate* share) {
  if (share == nullptr) return kAbsent;
  return share->interval ? fmt::format("{} ({})", Percent(share->value), Percent(*share->interval))
                         : Percent(share->value);
}

int Sum(const ReportSection& section, const std::string& detector, auto count) {
  int sum = 0;
  for (const CellSummary* row : section.rows) {
    if (row->detector == detector) sum += count(*row);
  }
  return sum;
}

// Of all cells of the section; "" where it is not known.
std::string PooledInterval(const ReportSection& section, const std::string& detector,
                           const char* rate, std::span<const PooledGroup> pooled) {
  const std::vector<std::optional<ParameterValue>> key = {
      section.part, std::string(ToString(section.sensor)), detector};
  for (const PooledGroup& group : pooled) {
    if (group.values != key) continue;
    const MetricEstimate* estimate = Find(group.metrics, rate);
    if (estimate != nullptr && estimate->interval) {
      return fmt::format(", 95 % interval {}", Percent(*estimate->interval));
    }
  }
  return "";
}

/// "- **near** (rgbd, paper-rgbd): 38 of 40 attempts hit (95.0 %), 95 % interval 83.1–99.4 %".
std::string HeadlineItem(const ReportSection& section, const std::string& detector,
                         std::span<const PooledGroup> pooled) {
  const auto total = [&](auto count) { return Sum(section, detector, count); };
  std::string text =
      fmt::format("- **{}** ({}, {}): ", section.part, ToString(section.sensor), detector);
  if (section.has_attempts) {
    const int hits = total([](const CellSummary& row) { return row.counts[Outcome::kHit]; });
    const int attempts = total([](const CellSummary& row) { return row.in_view; });
    text += fmt::format("{} of {} attempts hit", hits, attempts);
    if (attempts > 0) text += fmt::format(" ({})", Percent(static_cast<double>(hits) / attempts));
    text += PooledInterval(section, detector, "hit_rate", pooled);
    text += section.has_empty_scenes ? "; " : "";
  }
  if (section.has_empty_scenes) {
    text +=
        fmt::format("{} of {} scenes without a window gave a false alarm",
                    total([](const CellSummary& row) { return row.counts[Outcome::kFalseAlarm]; }),
                    total([](const CellSummary& row) { return row.without_target; }));
    text += PooledInterval(section, detector, "false_alarm_rate", pooled);
  }
  return text + "\n";
}

// In two cells.
void AddShare(const MetricEstimate* share, std::vector<std::string>& cells) {
  cells.push_back(share != nullptr ? Percent(share->value) : kAbsent);
  cells.push_back(share != nullptr && share->interval ? Percent(*share->interval) : kAbsent);
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
    AddShare(row->Find("hit_rate"), cells);
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
    AddShare(row->Find("false_alarm_rate"), cells);
    table.AddRow(std::move(cells));
  }
  return "### Scenes without a window\n\n" + table.ToMarkdown() + "\n";
}

// Hits within several shares of the window's side, and the same of the parts of the error.
std::string NearnessTable(const ReportSection& section) {
  constexpr std::pair<const char*, const char*> kColumns[] = {
      {"hits within 5 %", "hit_rate_5pct"},
      {"10 %", "hit_rate_10pct"},
      {"25 %", "hit_rate"},
      {"depth within 5 %", "depth_rate_5pct"},
      {"10 %", "depth_rate_10pct"},
      {"25 %", "depth_rate_25pct"},
      {"across within 5 %", "across_rate_5pct"},
      {"10 %", "across_rate_10pct"},
      {"25 %", "across_rate_25pct"}};
  TextTable table;
  AddKeyColumns(section, table);
  table.AddColumn("in view");
  for (const auto& [heading, metric] : kColumns) table.AddColumn(heading);
  bool known = false;
  for (const CellSummary* row : section.rows) {
    if (row->in_view == 0) continue;
    known |= row->Find("hit_rate_5pct") != nullptr;
    std::vector<std::string> cells = KeyCells(section, *row);
    cells.push_back(std::to_string(row->in_view));
    for (const auto& [heading, metric] : kColumns) {
      cells.push_back(ShareWithInterval(row->Find(metric)));
    }
    table.AddRow(std::move(cells));
  }
  if (!known) return "";
  return "### Attempts within a share of the window's side\n\n" + table.ToMarkdown() + "\n";
}

std::string ErrorTable(const ReportSection& section) {
  std::vector<std::pair<const char*, const char*>> of_hits = {
      {"bias x", "bias_x_mm"}, {"bias y", "bias_y_mm"},         {"bias z", "bias_z_mm"},
      {"RMSE", "rmse_mm"},     {"RMSE depth", "rmse_depth_mm"}, {"RMSE across", "rmse_across_mm"}};
  if (section.has_bounds) {
    of_hits.emplace_back("RMSE / bound", "rmse_over_bound");
    of_hits.emplace_back("depth / bound", "rmse_depth_over_bound");
  }
  TextTable table;
  AddKeyColumns(section, table);
  table.AddColumn("hits");
  for (const auto& [heading, metric] : of_hits) table.AddColumn(heading);
  for (const char* heading : {"in view", "P50", "P95"}) table.AddColumn(heading);
  for (const CellSummary* row : section.rows) {
    if (row->in_view == 0) continue;
    std::vector<std::string> cells = KeyCells(section, *row);
    cells.push_back(std::to_string(row->counts[Outcome::kHit]));
    for (const auto& [heading, metric] : of_hits) cells.push_back(WithInterval(row->Find(metric)));
    cells.push_back(std::to_string(row->in_view));
    for (const char* metric : {"p50_error_mm", "p95_error_mm"}) {
      cells.push_back(WithInterval(row->Find(metric)));
    }
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

std::string WithInterval(const StageMedian& stage) {
  return WithInterval(1e3 * stage.median_s, Interval{.lower = 1e3 * stage.interval_s.lower,
                                                     .upper = 1e3 * stage.interval_s.upper});
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
      cells.push_back(found == row->stage_medians.end() ? kAbsent : WithInterval(*found));
    }
    cells.push_back(WithInterval(row->Find("p50_time_ms")));
    cells.push_back(Significant(PaperMilliseconds(section.sensor)));
    table.AddRow(std::move(cells));
  }
  if (table.empty()) return "";
  return fmt::format("### Median time of {} [ms]\n\n{}\n", detector, table.ToMarkdown());
}

std::string Section(const ReportSection& section) {
  std::string text = "## " + Heading(section) + "\n\n";
  if (section.has_attempts)
    text += OutcomeTable(section) + NearnessTable(section) + ErrorTable(section);
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
window; they are the sum of `false_alarm`, `clear` and the crashes among them.

*hits within* 5, 10 and 25 % of the window's side (the smaller of its width and height) are shares of
the attempts in view; a `hit` is one within 25 %. *depth* and *across* hold the parts of the error, z
and √(x² + y²), against the same shares, of `gross` estimates too.

*bias* is the mean over the hits of estimate minus truth, in the frame of the scored camera: x to the
right, y down, z in depth. *RMSE* is over the hits, too: √(mean of x² + y² + z²), *depth* √(mean of
z²), *across* √(mean of x² + y²). */ bound* is the RMSE as a multiple of Cramér and Rao's bound for
the same hits, each where it stands: what an unbiased estimate that knows what the detector knows
could reach (docs/theory.md). *P50* and *P95* are quantiles of the three-dimensional error over all
attempts, where one without an estimate counts as infinite: `inf` in P95 says that more than 5 % of
the attempts gave no estimate, however small the RMSE of the others. — stands where there is no such
figure.

In parentheses stand the ends of 95 % intervals: of rates Clopper and Pearson's; of the bias
Student's t; of the RMSE a studentised bootstrap of its logarithm; of P50, P95 and median times order
statistics, with misses as +∞, so that an end may be infinite. Where cells could stop early, intervals
are wider, so that they cover together with 95 % at all looks. In a sensitivity design they are made
of the two trials of each row that share no draw. Cells share the random numbers of their trials
unless the study says otherwise: an interval of several cells together, as at the top, counts the
trials of one number as one witness (docs/studies.md). intervals.csv has all metrics, with the method
and the number of witnesses of each.

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

std::string SummaryMarkdown(const ReportTitle& title, std::span<const CellSummary> summaries,
                            std::span<const PooledGroup> pooled) {
  std::string text = fmt::format("# {}\n\n", title.study);
  if (!title.description.empty()) text += title.description + "\n\n";
  const std::vector<ReportSection> sections = MakeSections(summaries);
  if (sections.empty()) text += "No trials.\n";
  for (const ReportSection& section : sections) {
    for (const std::string& detector : section.detectors) {
      text += HeadlineItem(section, detector, pooled);
    }
  }
  text += "\n";
  for (const ReportSection& section : sections) text += Section(section);
  return text + HowToRead() + Provenance(title);
}

}  // namespace fenestra
