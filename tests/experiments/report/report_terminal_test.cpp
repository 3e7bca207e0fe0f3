#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "experiments/analysis/cell_tally.h"
#include "experiments/output/text_table.h"
#include "experiments/report/report.h"
#include "tests/experiments/report/report_examples.h"

namespace fenestra {
namespace {

using testing::ExampleRows;
using ::testing::HasSubstr;
using testing::Lines;

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

}  // namespace
}  // namespace fenestra
