#include "experiments/report/row_reports.h"

#include "core/io/image_io.h"
#include "core/io/temporary_files.h"
#include "experiments/report/detector_comparison_report.h"
#include "experiments/report/envelope_report.h"
#include "experiments/report/error_budget_report.h"

namespace fenestra {

RowReports::RowReports(const Study& study, std::span<const Cell> cells)
    : study_(study), context_(study, cells), budgets_(study, cells), plan_(study, cells) {}

void RowReports::Add(const TrialRecord& row) {
  if (context_.Of(row).is_independent) comparisons_.Add(row);
  budgets_.Add(row);
  plan_.Add(row);
}

std::string RowReports::Markdown() const {
  std::string text;
  for (const std::string& section :
       {ComparisonMarkdown(comparisons_.Comparisons()), ErrorBudgetMarkdown(budgets_.Budgets()),
        EnvelopeMarkdown(study_, plan_.Envelopes())}) {
    if (!section.empty()) text += "\n" + section;
  }
  return text;
}

std::map<std::string, std::string> RowReports::Files() const {
  std::map<std::string, std::string> files;
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

void WriteRowReports(const RowReports& reports, const Study& study, const OutputPath& folder) {
  folder.RemoveOwn(kRowReportFiles);
  for (const auto& [name, text] : reports.Files()) WriteFileAtomically(folder / name, text);
  if (const auto picture = EnvelopePicture(study, reports.Envelopes())) {
    WritePng(folder / "envelope.png", *picture);
  }
}

}  // namespace fenestra
