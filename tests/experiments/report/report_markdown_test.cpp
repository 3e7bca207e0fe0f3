#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/analysis/cell_tally.h"
#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"
#include "experiments/report/report.h"
#include "tests/experiments/report/parse_csv.h"
#include "tests/experiments/report/report_examples.h"

namespace fenestra {
namespace {

using testing::ExampleRows;
using ::testing::HasSubstr;
using testing::Lines;
using ::testing::Not;
using testing::ParseTable;
using testing::ToNumber;

TEST(SummaryMarkdown, EveryTableIsAlignedAndRectangular) {
  const std::vector<TrialRecord> rows = ExampleRows();
  const std::string text = SummaryMarkdown(
      {.study = "paper", .description = "Does it?", .provenance = {{"seed", "1"}, {"a|b", "c\nd"}}},
      Summarise(rows));
  size_t width = 0;
  int tables = 0;
  for (const std::string& line : Lines(text)) {
    if (!line.starts_with("|")) {
      width = 0;
      continue;
    }
    if (width == 0) {
      width = DisplayWidth(line);
      ++tables;
    }
    EXPECT_EQ(DisplayWidth(line), width) << line;
  }
  // Outcomes, errors, reasons and two detectors' times; false alarms and times; provenance.
  // ("paper-stereo" and "other" are timed, so is "empty".)
  EXPECT_EQ(tables, 8);
}

TEST(SummaryMarkdown, SaysWhatItsWordsMean) {
  const std::vector<TrialRecord> rows = ExampleRows();
  const std::string text = SummaryMarkdown({.study = "paper"}, Summarise(rows));
  for (const Outcome outcome : kAllOutcomes) {
    EXPECT_THAT(text, HasSubstr(std::string("`") + ToString(outcome) + "`: "));
  }
  EXPECT_THAT(text, HasSubstr("56 of 59 attempts hit (94.9 %)"));
  EXPECT_THAT(text, HasSubstr("1 of 8 scenes without a window gave a false alarm"));
  EXPECT_THAT(text, HasSubstr("| 2 of 20 |"));
  EXPECT_THAT(text, HasSubstr("|   200 |"));
  EXPECT_THAT(text, HasSubstr("|   800 |"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(Reports, ShowErrorsAsMultiplesOfTheirBound) {
  std::vector<TrialRecord> rows = ExampleRows();
  EXPECT_THAT(SummaryMarkdown({.study = "paper"}, Summarise(rows)), Not(HasSubstr("RMSE / bound")));
  EXPECT_EQ(ParseTable(SummaryCsv(Summarise(rows)))[0].at("rmse_over_bound"), "");
  for (TrialRecord& row : rows) row.bound_C = 1e-4 / 16.0 * Eigen::Matrix3d::Identity();
  const auto summaries = Summarise(rows);
  const HitErrors& errors = summaries[0].hit_errors.value();
  const auto summary = ParseTable(SummaryCsv(summaries));
  EXPECT_EQ(ToNumber(summary[0].at("bound_depth_mm")), 2.5);
  EXPECT_EQ(ToNumber(summary[0].at("rmse_depth_over_bound")), errors.rmse_depth / 0.0025);
  EXPECT_EQ(ToNumber(summary[0].at("rmse_over_bound")), *errors.OverBound());
  EXPECT_EQ(ToNumber(ParseTable(TrialsCsv(rows))[1].at("bound_z_mm")), 2.5);
  const std::string markdown = SummaryMarkdown({.study = "paper"}, summaries);
  EXPECT_THAT(markdown, HasSubstr("RMSE / bound"));
  EXPECT_THAT(markdown, HasSubstr(Significant(errors.DepthOverBound())));
  EXPECT_THAT(SummaryForTerminal(summaries), HasSubstr("3D/b"));
}

}  // namespace
}  // namespace fenestra
