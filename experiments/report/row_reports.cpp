#include "experiments/report/row_reports.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/image_io.h"
#include "core/io/temporary_files.h"
#include "experiments/output/file_formats.h"
#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"
#include "experiments/report/detector_comparison_report.h"
#include "experiments/report/envelope_report.h"
#include "experiments/report/error_budget_report.h"
#include "experiments/report/report_section.h"
#include "experiments/sampling/causes.h"

namespace fenestra {
namespace {

// Those that a table has room for; intervals.csv has all.
constexpr const char* kTableFigures[] = {"hit_rate",     "false_alarm_rate", "bias_x_mm",
                                         "bias_y_mm",    "bias_z_mm",        "rmse_mm",
                                         "p50_error_mm", "p95_error_mm"};

std::string CellText(const FigureEstimate& estimate) {
  const double scale = estimate.figure.ends_with("_rate") ? 100.0 : 1.0;
  std::string text = Significant(scale * estimate.value);
  if (!estimate.interval) return text;
  return text + fmt::format(" ({} to {})", Significant(scale * estimate.interval->lower),
                            Significant(scale * estimate.interval->upper));
}

constexpr const char* kHowToReadIntervals = R"md(
In parentheses the ends of the 95 % intervals: of rates [%] Clopper and Pearson's; of the bias [mm]
over the hits Student's t; of the RMSE a studentised bootstrap of its logarithm; of P50 and P95 [mm]
over all attempts order statistics, with misses as +∞, so that an end may be infinite. Where cells
could stop early, intervals are wider, so that they cover together with 95 % at all looks.
intervals.csv has the rates of all outcomes, too.
)md";

}  // namespace

RowReports::RowReports(const Study& study, std::span<const Cell> cells)
    : study_(study), cells_(cells), budgets_(study, cells), plan_(study, cells) {
  for (const Cell& cell : cells) causes_.push_back(CausesOf(study, cell).size());
}

bool RowReports::IsIndependent(const TrialRecord& row) const {
  const size_t causes = causes_[static_cast<size_t>(row.cell)];
  return causes == 0 || PickFreezePlace::Of(row.trial, causes).column <= 1;
}

void RowReports::Add(const TrialRecord& row) {
  if (IsIndependent(row)) {
    figures_[{row.cell, row.detector}].Add(row);
    comparisons_.Add(row);
  }
  budgets_.Add(row);
  plan_.Add(row);
}

std::string RowReports::IntervalsCsv() const {
  CsvWriter csv;
  csv.AddAll({"part", "sensor", "cell", "detector", "levels", "figure", "value", "of", "lower",
              "upper", "confidence", "method"});
  csv.EndLine();
  for (const auto& [key, tally] : figures_) {
    const Cell& cell = cells_[static_cast<size_t>(key.first)];
    const double confidence = SummaryConfidence(study_, cell);
    for (const FigureEstimate& estimate : tally.Figures(confidence)) {
      csv.Add(cell.part).Add(ToString(cell.sensor)).Add(cell.index).Add(key.second);
      csv.Add(LevelsText(cell.levels)).Add(estimate.figure).Add(estimate.value).Add(estimate.of);
      const auto& interval = estimate.interval;
      csv.Add(interval ? std::optional(interval->lower) : std::nullopt);
      csv.Add(interval ? std::optional(interval->upper) : std::nullopt);
      csv.Add(confidence).Add(estimate.method).EndLine();
    }
  }
  return csv.text();
}

std::string RowReports::IntervalsMarkdown() const {
  TextTable table;
  for (const char* heading : {"part", "sensor", "detector", "levels"}) {
    table.AddColumn(heading, TextTable::Align::kLeft);
  }
  for (const char* figure : kTableFigures) table.AddColumn(figure);
  for (const auto& [key, tally] : figures_) {
    const Cell& cell = cells_[static_cast<size_t>(key.first)];
    const auto figures = tally.Figures(SummaryConfidence(study_, cell));
    std::vector<std::string> cells{cell.part, ToString(cell.sensor), key.second,
                                   LevelsText(cell.levels)};
    for (const char* figure : kTableFigures) {
      const auto found = std::find_if(figures.begin(), figures.end(),
                                      [figure](const auto& f) { return f.figure == figure; });
      cells.push_back(found == figures.end() ? kAbsent : CellText(*found));
    }
    table.AddRow(std::move(cells));
  }
  return "## Intervals\n\n" + table.ToMarkdown() + kHowToReadIntervals;
}

std::string RowReports::Markdown() const {
  std::string text;
  for (const std::string& section :
       {IntervalsMarkdown(), ComparisonMarkdown(comparisons_.Comparisons()),
        ErrorBudgetMarkdown(budgets_.Budgets()), EnvelopeMarkdown(study_, plan_.Envelopes())}) {
    if (!section.empty()) text += "\n" + section;
  }
  return text;
}

std::map<std::string, std::string> RowReports::Files() const {
  std::map<std::string, std::string> files{{"intervals.csv", IntervalsCsv()}};
  if (const auto comparisons = comparisons_.Comparisons(); !comparisons.empty()) {
    files["comparison.csv"] = ComparisonCsv(comparisons);
  }
  if (const auto budgets = budgets_.Budgets(); !budgets.empty()) {
    files["error_budget.csv"] = ErrorBudgetCsv(budgets);
  }
  if (const auto envelopes = plan_.Envelopes(); !envelopes.empty()) {
    files["envelope.csv"] = EnvelopeCsv(study_, envelopes);
  }
  return files;
}

void WriteRowReports(const RowReports& reports, const Study& study,
                     const std::filesystem::path& folder) {
  for (const std::string& name : kRowReportFiles) std::filesystem::remove(folder / name);
  for (const auto& [name, text] : reports.Files()) WriteFileAtomically(folder / name, text);
  if (const auto picture = EnvelopePicture(study, reports.Envelopes())) {
    WritePng(folder / "envelope.png", *picture);
  }
}

}  // namespace fenestra
