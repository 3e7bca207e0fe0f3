#include "experiments/check/check_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fenestra {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

CheckResult Example() {
  return {.limits = {{.text = "rate(hit) >= 0.9",
                      .verdict = Verdict::kHolds,
                      .measured = "98.0 %",
                      .rows = 50,
                      .clusters = 50},
                     {.text = "p95(centroid_error_mm) <= 15 where detector = \"a&b\"",
                      .cell = "cell 1 (main, distance_m = 3)",
                      .verdict = Verdict::kViolated,
                      .measured = "21 mm",
                      .rows = 50,
                      .clusters = 50},
                     {.text = "rate(missed) <= 0.1",
                      .verdict = Verdict::kUndecided,
                      .measured = "8.0 %",
                      .rows = 50,
                      .clusters = 50,
                      .replicates_to_decide = 800}},
          .false_alarm = 0.05,
          .test_level = 0.05 / 3.0};
}

TEST(CheckReport, TheTerminalSaysWhatWouldDecide) {
  EXPECT_THAT(CheckForTerminal(Example()),
              AllOf(HasSubstr("1 hold, 1 violated, 1 undecided"), HasSubstr("VIOLATED"),
                    HasSubstr("about 800 replicates would decide (now 50)")));
}

TEST(CheckReport, MarkdownFoldsAwayWhatHolds) {
  const std::string text = CheckMarkdown(Example());
  EXPECT_LT(text.find("VIOLATED"), text.find("<details>"));
  EXPECT_GT(text.find("98.0 %"), text.find("<details>"));
}

TEST(CheckReport, JunitCountsAndEscapes) {
  const std::string lenient = CheckJunitXml(Example(), "limits", false);
  EXPECT_THAT(lenient, AllOf(HasSubstr("tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\""),
                             HasSubstr("&lt;= 15 where detector = &quot;a&amp;b&quot;"),
                             Not(HasSubstr("a&b"))));
  const std::string strict = CheckJunitXml(Example(), "limits", true);
  EXPECT_THAT(strict, HasSubstr("failures=\"2\" errors=\"0\" skipped=\"0\""));
}

}  // namespace
}  // namespace fenestra
