#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/io/output_path.h"
#include "experiments/analysis/detector_comparison.h"
#include "experiments/analysis/error_budget.h"
#include "experiments/analysis/trial_plan.h"
#include "experiments/study/study.h"

namespace fenestra {

/// What is derived from a study's rows beside the summary of each cell: comparisons of detectors,
/// error budgets, envelopes. Of each row it keeps a few numbers. Comparisons take trials to be
/// independent; of a sensitivity design's rows they use the two trials that have nothing in common.
class RowReports {
 public:
  /// Keeps references to both.
  RowReports(const Study& study, std::span<const Cell> cells);

  /// Rows by cell and trial.
  void Add(const TrialRecord& row);

  /// Sections to stand after the summary.
  std::string Markdown() const;
  /// Text files by name, those that have something to say: comparison.csv, error_budget.csv,
  /// envelope.csv.
  std::map<std::string, std::string> Files() const;
  /// Of the study, so far.
  std::vector<EnvelopeCurve> Envelopes() const { return plan_.Envelopes(); }

 private:
  const Study& study_;
  RowContext context_;
  DetectorComparisons comparisons_;
  ErrorBudgets budgets_;
  TrialPlan plan_;
};

/// Writes Files() and, for an envelope with curves to draw, envelope.png.
void WriteRowReports(const RowReports& reports, const Study& study, const OutputPath& folder);

/// The names of all files that WriteRowReports may write.
inline const std::vector<std::string> kRowReportFiles{"comparison.csv", "error_budget.csv",
                                                      "envelope.csv", "envelope.png"};

}  // namespace fenestra
