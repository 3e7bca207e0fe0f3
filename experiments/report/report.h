#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/analysis/cell_summary.h"
#include "experiments/analysis/pooled_metrics.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// Reports are texts, made from rows and summaries alone; the caller writes them to files.
///
/// CSV: fields are quoted as in RFC 4180, lines end with a line feed, the first line has the column
/// names, numbers are in the shortest form that reads back exactly, an absent value is an empty
/// field and infinity is "inf". Rows and columns keep the order of the input; a factor or a stage
/// gets its column where it first occurs.

/// One line per row: key, factors, outcome, errors [mm], estimate and truth [m], and last the
/// times [ms], which are all that differs between two runs of one study.
std::string TrialsCsv(std::span<const TrialRecord> records);

/// Shows rows to a visitor, all of them every time it is called.
using RowPass = std::function<void(const std::function<void(const TrialRecord&)>&)>;

/// Writes TrialsCsv's text for rows that are not all in memory, in two passes: columns, then lines.
void WriteTrialsCsv(const RowPass& for_each_row, std::ostream& out);

/// One line per cell and detector: counts, then every metric with the ends of its interval.
std::string SummaryCsv(std::span<const CellSummary> summaries);

/// One line per cell, detector and metric, with its denominator, its interval, how the interval was
/// made and of how many independent witnesses.
std::string IntervalsCsv(std::span<const CellSummary> summaries);

/// The text above and below the tables of a report.
struct ReportTitle {
  std::string study;
  std::string description = "";
  /// Name and value of what the figures depend on: version, seed, processor.
  std::vector<std::pair<std::string, std::string>> provenance = {};
};

/// The report for people: a headline, one section per part and sensor with its outcomes, errors,
/// reasons and times, and how to read them.
///
/// `pooled` has the rows of all cells of a part, sensor and detector together (Pooling{}), for the
/// intervals of the headline; it may be empty.
std::string SummaryMarkdown(const ReportTitle& title, std::span<const CellSummary> summaries,
                            std::span<const PooledGroup> pooled = {});

/// Compact tables for a terminal of 120 columns, as long as few factors vary; of 136 columns where
/// errors have bounds.
std::string SummaryForTerminal(std::span<const CellSummary> summaries);

}  // namespace fenestra
