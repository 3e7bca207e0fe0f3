#include "experiments/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>

#include "experiments/analysis/cell_tally.h"
#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::RandomHit;
using testing::Row;
using testing::RowWithError;

using CsvLine = std::vector<std::string>;

/// A reader of RFC 4180 that knows nothing of the writer.
std::vector<CsvLine> ParseCsv(const std::string& text) {
  std::vector<CsvLine> lines(1, CsvLine(1));
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        lines.back().back() += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        lines.back().back() += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      lines.back().emplace_back();
    } else if (c == '\n') {
      lines.emplace_back(1);
    } else {
      lines.back().back() += c;
    }
  }
  lines.pop_back();  // After the last line feed.
  return lines;
}

/// Lines by column name.
std::vector<std::map<std::string, std::string>> ParseTable(const std::string& text) {
  const std::vector<CsvLine> lines = ParseCsv(text);
  std::vector<std::map<std::string, std::string>> table;
  for (size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].size(), lines[0].size()) << "line " << i;
    table.emplace_back();
    for (size_t k = 0; k < lines[0].size(); ++k) table.back()[lines[0][k]] = lines[i].at(k);
    EXPECT_EQ(table.back().size(), lines[0].size()) << "a column occurs twice";
  }
  return table;
}

double ToNumber(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Two sensors, two detectors on one of them, all outcomes; one part without a window.
std::vector<TrialRecord> ExampleRows() {
  std::vector<TrialRecord> rows;
  for (int cell = 0; cell < 3; ++cell) {
    for (int trial = 0; trial < 20; ++trial) {
      for (const char* detector : {"paper-stereo", "other"}) {
        rows.push_back(RandomHit(cell, trial, detector));
      }
    }
  }
  rows[0] = Row(0, 0, Outcome::kMissed, "paper-stereo");
  rows[2] = Row(0, 1, Outcome::kMissed, "paper-stereo");
  rows[4] = RowWithError(0, 2, Outcome::kGross, {0.0, 0.0, 0.7}, "paper-stereo");
  rows[6] = Row(0, 3, Outcome::kOutOfView, "paper-stereo");
  for (int trial = 0; trial < 8; ++trial) {
    TrialRecord row = Row(3, trial, trial == 0 ? Outcome::kFalseAlarm : Outcome::kClear, "empty");
    row.part = "no_window";
    row.sensor = SensorKind::kRgbd;
    row.levels.clear();
    row.stages = {{"segment", 0.0123}};
    rows.push_back(row);
  }
  return rows;
}

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
  EXPECT_EQ(ToNumber(table[0].at("bias_x_mm")), 1e3 * summaries[0].hit_errors->bias.x());
  EXPECT_EQ(table[6].at("hit_rate"), "");
  EXPECT_EQ(table[6].at("false_alarm_rate"), "0.125");
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

TEST(SummaryForTerminal, FitsAndShowsEveryRow) {
  std::vector<TrialRecord> rows = ExampleRows();
  for (const std::string& line : Lines(SummaryForTerminal(Summarise(rows)))) {
    EXPECT_LE(DisplayWidth(line), 120u) << line;
  }
  for (TrialRecord& row : rows) row.bound_C = 1e-4 * Eigen::Matrix3d::Identity();
  const std::string text = SummaryForTerminal(Summarise(rows));
  std::map<std::string, int> seen;
  for (const std::string& line : Lines(text)) {
    EXPECT_LE(DisplayWidth(line), 136u) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
    for (const char* detector : {"paper-stereo  ", "other  "}) {
      if (line.find(detector) != std::string::npos) ++seen[detector];
    }
  }
  EXPECT_EQ(seen["paper-stereo  "], 3);
  EXPECT_EQ(seen["other  "], 3);
  EXPECT_THAT(text, HasSubstr("no_window: rgbd, empty"));
  EXPECT_THAT(text, HasSubstr("inf"));
  EXPECT_THAT(text, HasSubstr("alarms"));
  EXPECT_EQ(SummaryForTerminal({}), "no trials\n");
}

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

TEST(NumberFormat, ShowsThreeSignificantDigits) {
  EXPECT_EQ(Significant(0.0), "0");
  EXPECT_EQ(Significant(12345.6), "12346");
  EXPECT_EQ(Significant(123.4), "123");
  EXPECT_EQ(Significant(-12.34), "-12.3");
  EXPECT_EQ(Significant(1.234), "1.23");
  EXPECT_EQ(Significant(9.996), "10.0");
  EXPECT_EQ(Significant(99.96), "100");
  EXPECT_EQ(Significant(0.1234), "0.123");
  EXPECT_EQ(Significant(-0.0004), "0.000");
  EXPECT_EQ(Significant(std::nullopt), "—");
  EXPECT_EQ(Significant(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(WithStandardError(-1.2345, 0.456), "-1.23 ± 0.46");
  EXPECT_EQ(WithStandardError(1234.6, 45.6), "1235 ± 46");
  EXPECT_EQ(Percent(0.9501), "95.0 %");
}

TEST(TextTable, AlignsByCharactersNotBytes) {
  TextTable table;
  table.AddColumn("größe", TextTable::Align::kLeft);
  table.AddColumn("n");
  table.AddRow({"—", "1000"});
  table.AddRow({"1.2 ± 0.3", "7"});
  const std::vector<std::string> lines = Lines(table.ToPlainText());
  ASSERT_EQ(lines.size(), 4u);
  for (const std::string& line : lines) EXPECT_EQ(DisplayWidth(line), 15u) << line;
  EXPECT_THROW(table.AddRow({"too few"}), std::logic_error);
}

}  // namespace
}  // namespace fenestra
