#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/analysis/cell_tally.h"
#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"
#include "experiments/report/report.h"
#include "tests/experiments/report/parse_csv.h"
#include "tests/experiments/report/report_examples.h"
#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

using testing::ExampleRows;
using ::testing::HasSubstr;
using testing::Lines;
using ::testing::Not;
using testing::ParseTable;
using testing::RandomHit;
using testing::Row;
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

// Of a cell that may stop early, and of a sensitivity design: each is 95 % true in its own way.
TEST(Reports, OneRateHasOneIntervalWhereverItStands) {
  const std::string study =
      "name: test\nsensors: [stereo]\nrepetitions: 40\nfactors:\n  distance_m: [2, 3]\n"
      "  yaw_deg: {uniform: [-2, 2]}\n";
  for (const char* line : {"until: {hit_rate: 0.1}\n", "design: sensitivity\n"}) {
    const Study ruled = ReadText(study + line);
    std::vector<TrialRecord> rows;
    for (int trial = 0; trial < 40; ++trial) {
      rows.push_back(trial % 7 == 3 ? Row(0, trial, Outcome::kMissed) : RandomHit(0, trial, "a"));
    }
    const auto summaries = Summarise(rows, RowContext(ruled, Cells(ruled)));
    const auto summary = ParseTable(SummaryCsv(summaries)).at(0);
    for (const auto& row : ParseTable(IntervalsCsv(summaries))) {
      const std::string& name = row.at("figure");
      EXPECT_EQ(row.at("value"),
                name == "p50_time_ms" ? summary.at("time_total_median_ms") : summary.at(name));
      if (name == "p50_time_ms") continue;
      EXPECT_EQ(row.at("lower"), summary.at(ColumnOf(name, "_lower95"))) << name;
      EXPECT_EQ(row.at("upper"), summary.at(ColumnOf(name, "_upper95"))) << name;
    }
    const Interval& interval = *summaries.at(0).Find("hit_rate")->interval;
    // The interval of 34 hits in 40 independent rows looked at once.
    EXPECT_NE(interval.lower, ClopperPearson(34, 40).lower) << line;
    const std::string markdown = SummaryMarkdown({.study = "test"}, summaries);
    EXPECT_THAT(markdown, HasSubstr(Percent(interval)));
    EXPECT_THAT(markdown, Not(HasSubstr(Percent(ClopperPearson(34, 40)))));
  }
}

TEST(Reports, SeveralCellsTogetherCountASharedReplicateOnce) {
  const Study study = ReadText(
      "name: test\nsensors: [stereo]\nrepetitions: 20\nparts: [{name: window}]\n"
      "factors: {distance_m: [2, 3, 4]}\n");
  const std::vector<Cell> cells = Cells(study);
  PooledMetrics pooled(study, cells, {});
  std::vector<TrialRecord> rows;
  for (int cell = 0; cell < 3; ++cell) {
    for (int trial = 0; trial < 20; ++trial) {
      rows.push_back(RandomHit(cell, trial));
      pooled.Add(rows.back());
    }
  }
  // 60 of 60 hits, of 20 replicates.
  EXPECT_THAT(SummaryMarkdown({.study = "test"}, Summarise(rows), pooled.Groups()),
              HasSubstr("60 of 60 attempts hit (100.0 %), 95 % interval " +
                        Percent(ClopperPearson(20, 20))));
}

TEST(Reports, ShowErrorsAsMultiplesOfTheirBound) {
  std::vector<TrialRecord> rows = ExampleRows();
  EXPECT_THAT(SummaryMarkdown({.study = "paper"}, Summarise(rows)), Not(HasSubstr("RMSE / bound")));
  EXPECT_EQ(ParseTable(SummaryCsv(Summarise(rows)))[0].at("rmse_over_bound"), "");
  for (TrialRecord& row : rows) row.bound_C = 1e-4 / 16.0 * Eigen::Matrix3d::Identity();
  const auto summaries = Summarise(rows);
  const double over_bound = summaries[0].Value("rmse_over_bound").value();
  const double depth_over_bound = summaries[0].Value("rmse_depth_over_bound").value();
  const auto summary = ParseTable(SummaryCsv(summaries));
  EXPECT_EQ(ToNumber(summary[0].at("bound_depth_mm")), 2.5);
  EXPECT_EQ(ToNumber(summary[0].at("rmse_depth_over_bound")), depth_over_bound);
  EXPECT_NEAR(depth_over_bound, summaries[0].Value("rmse_depth_mm").value() / 2.5, 1e-12);
  EXPECT_EQ(ToNumber(summary[0].at("rmse_over_bound")), over_bound);
  EXPECT_EQ(ToNumber(ParseTable(TrialsCsv(rows))[1].at("bound_z_mm")), 2.5);
  const std::string markdown = SummaryMarkdown({.study = "paper"}, summaries);
  EXPECT_THAT(markdown, HasSubstr("RMSE / bound"));
  EXPECT_THAT(markdown, HasSubstr(Significant(depth_over_bound)));
  EXPECT_THAT(SummaryForTerminal(summaries), HasSubstr("3D/b"));
}

}  // namespace
}  // namespace fenestra
