#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/analysis/cell_tally.h"
#include "experiments/report/report.h"
#include "tests/experiments/report/parse_csv.h"
#include "tests/experiments/report/report_examples.h"

namespace fenestra {
namespace {

using testing::CsvLine;
using testing::ExampleRows;
using testing::ParseCsv;
using testing::ParseTable;
using testing::ToNumber;

TEST(TrialsCsv, ReadsBackWithEveryBit) {
  std::vector<TrialRecord> rows = ExampleRows();
  rows[0].score.detail = "found 2, \"needed\" 4\r\nlines; näher";
  rows[1].levels.emplace_back("scene", std::string("facade, \"old\""));
  const auto table = ParseTable(TrialsCsv(rows));
  ASSERT_EQ(table.size(), rows.size());
  EXPECT_EQ(table[0].at("detail"), rows[0].score.detail);
  EXPECT_EQ(table[0].at("reason"), "no_contour");
  EXPECT_EQ(table[0].at("estimate_x_m"), "");
  EXPECT_EQ(table[1].at("scene"), "facade, \"old\"");
  EXPECT_EQ(table[2].at("scene"), "");
  for (size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(table[i].at("detector"), rows[i].detector);
    EXPECT_EQ(table[i].at("outcome"), ToString(rows[i].score.outcome));
    if (rows[i].score.estimate) {
      EXPECT_EQ(ToNumber(table[i].at("estimate_z_m")), rows[i].score.estimate->p_CO.z());
      EXPECT_EQ(ToNumber(table[i].at("estimate_bottom_left_y_m")),
                rows[i].score.estimate->p_CV[3].y());
    }
    if (const auto error = rows[i].score.CentroidError_C()) {
      EXPECT_EQ(ToNumber(table[i].at("centroid_error_y_mm")), error->y() * 1e3);
    }
  }
}

TEST(TrialsCsv, TimesComeLast) {
  const std::vector<TrialRecord> rows = ExampleRows();
  const std::vector<CsvLine> lines = ParseCsv(TrialsCsv(rows));
  const CsvLine& header = lines.at(0);
  const auto total = std::find(header.begin(), header.end(), "time_total_ms");
  ASSERT_NE(total, header.end());
  for (auto name = header.begin(); name != header.end(); ++name) {
    EXPECT_EQ(name->starts_with("time_"), name >= total) << *name;
  }
}

TEST(SummaryCsv, HasEveryFigureWithItsDenominator) {
  const std::vector<TrialRecord> rows = ExampleRows();
  const auto summaries = Summarise(rows);
  const auto table = ParseTable(SummaryCsv(summaries));
  ASSERT_EQ(table.size(), 7u);
  for (const auto& line : table) {
    int in_view = 0;
    for (const char* name : {"hit", "gross", "wrong_window", "missed", "crashed"}) {
      in_view += std::stoi(line.at(name));
    }
    EXPECT_EQ(in_view, std::stoi(line.at("in_view")));
    EXPECT_EQ(in_view + std::stoi(line.at("out_of_view")) + std::stoi(line.at("without_target")),
              std::stoi(line.at("trials")));
  }
  EXPECT_EQ(table[1].at("detector"), "paper-stereo");
  EXPECT_EQ(table[1].at("p95_error_mm"), "inf");  // Two misses in 19 attempts.
  EXPECT_EQ(table[1].at("reasons"), "missed/no_contour: 2");
  EXPECT_EQ(ToNumber(table[0].at("bias_x_mm")), summaries[0].Value("bias_x_mm"));
  EXPECT_EQ(table[6].at("hit_rate"), "");
  EXPECT_EQ(table[6].at("false_alarm_rate"), "0.125");
}

}  // namespace
}  // namespace fenestra
