#include "experiments/report/detector_comparison_report.h"

#include <fmt/format.h>

#include "experiments/output/file_formats.h"
#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"
#include "experiments/report/report_section.h"

namespace fenestra {
namespace {

std::string PValue(double p) {
  return p < 0.001 ? "< 0.001" : fmt::format("{:.3f}", p);
}

std::string Between(double value, const Interval& interval, const char* unit) {
  return fmt::format("{} ({} to {}){}", Significant(value), Significant(interval.lower),
                     Significant(interval.upper), unit);
}

std::vector<std::string> Cells(const DetectorComparison& row) {
  const Interval& rates = row.rate_difference_interval;
  const ErrorComparison& errors = row.errors;
  std::string mean = kAbsent;
  if (errors.mean_difference) {
    const Interval& interval = *errors.mean_difference_interval;
    mean = Between(1e3 * *errors.mean_difference,
                   {.lower = 1e3 * interval.lower, .upper = 1e3 * interval.upper}, "");
  }
  return {LevelsText(row.levels),
          row.first + " − " + row.second,
          std::to_string(row.successes.pairs()),
          Between(100.0 * row.successes.difference(),
                  {.lower = 100.0 * rates.lower, .upper = 100.0 * rates.upper}, " %"),
          fmt::format("{} : {}", row.successes.only_first, row.successes.only_second),
          PValue(row.mcnemar_p),
          fmt::format("{} : {}", errors.first_nearer, errors.second_nearer),
          PValue(errors.sign_test_p),
          mean};
}

constexpr const char* kHowToReadComparison = R"md(
Both detectors of a line saw the same pixels. *success rate* is the difference of the rates of hits
(of `clear` in scenes without a window) with its 95 % interval (Tango's score interval), *only one*
counts trials in which the one or the other alone succeeded, and *p* beside it is McNemar's, exact.
*nearer* counts trials in which the one or the other was nearer to the truth, a trial without an
estimate being infinitely far, with the exact p-value of the sign test. *error* is the mean
difference of the three-dimensional error in mm where both gave an estimate, with its 95 % t
interval. Each p-value is that of its line alone: of 20 lines without a difference one falls below
0.05.
)md";

}  // namespace

std::string ComparisonMarkdown(std::span<const DetectorComparison> comparisons) {
  if (comparisons.empty()) return "";
  std::string text = "## Detectors beside each other\n\n";
  for (size_t begin = 0; begin < comparisons.size();) {
    const DetectorComparison& head = comparisons[begin];
    TextTable table;
    table.AddColumn("levels", TextTable::Align::kLeft);
    table.AddColumn("detectors", TextTable::Align::kLeft);
    for (const char* heading :
         {"trials", "success rate", "only one", "p", "nearer", "p", "error [mm]"}) {
      table.AddColumn(heading);
    }
    size_t end = begin;
    while (end < comparisons.size() && comparisons[end].part == head.part &&
           comparisons[end].sensor == head.sensor) {
      table.AddRow(Cells(comparisons[end++]));
    }
    text += fmt::format("### {}: {}\n\n{}\n", head.part, ToString(head.sensor), table.ToMarkdown());
    begin = end;
  }
  return text + kHowToReadComparison;
}

std::string ComparisonCsv(std::span<const DetectorComparison> comparisons) {
  CsvWriter csv;
  csv.AddAll({"part",
              "sensor",
              "cell",
              "levels",
              "first",
              "second",
              "pairs",
              "both_succeed",
              "only_first",
              "only_second",
              "neither",
              "rate_difference",
              "rate_difference_lower95",
              "rate_difference_upper95",
              "mcnemar_p",
              "first_nearer",
              "second_nearer",
              "sign_test_p",
              "both_estimate",
              "mean_error_difference_mm",
              "mean_error_difference_lower95_mm",
              "mean_error_difference_upper95_mm"});
  csv.EndLine();
  for (const DetectorComparison& row : comparisons) {
    const PairedCounts& counts = row.successes;
    csv.Add(row.part).Add(ToString(row.sensor)).Add(row.cell).Add(LevelsText(row.levels));
    csv.Add(row.first).Add(row.second).Add(counts.pairs()).Add(counts.both);
    csv.Add(counts.only_first).Add(counts.only_second).Add(counts.neither);
    csv.Add(counts.difference()).Add(row.rate_difference_interval.lower);
    csv.Add(row.rate_difference_interval.upper).Add(row.mcnemar_p);
    csv.Add(row.errors.first_nearer).Add(row.errors.second_nearer).Add(row.errors.sign_test_p);
    csv.Add(row.errors.both_finite).Add(ToMilli(row.errors.mean_difference));
    const auto& interval = row.errors.mean_difference_interval;
    csv.Add(ToMilli(interval ? std::optional(interval->lower) : std::nullopt));
    csv.Add(ToMilli(interval ? std::optional(interval->upper) : std::nullopt)).EndLine();
  }
  return csv.text();
}

}  // namespace fenestra
