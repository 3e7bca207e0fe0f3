#include "experiments/check/limit_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "experiments/check/limit_file.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;

TEST(LimitText, EveryPartIsRead) {
  const Limit limit = ParseLimit(
      "p99.9(centroid_error_z_mm) <= 15 with confidence 0.9 in each cell where detector = "
      "edge-stereo and distance_m <= 3 and scene in [facade, paper_target]",
      0.95);
  EXPECT_EQ(limit.metric.kind, Metric::Kind::kQuantile);
  EXPECT_DOUBLE_EQ(limit.metric.level, 0.999);
  EXPECT_EQ(limit.metric.quantity, Quantity::kErrorZ);
  EXPECT_TRUE(limit.is_upper);
  EXPECT_EQ(limit.value, 15.0);
  EXPECT_EQ(limit.confidence, 0.9);
  EXPECT_TRUE(limit.in_each_cell);
  EXPECT_FALSE(limit.to_baseline);
  ASSERT_EQ(limit.where.size(), 3u);
  EXPECT_EQ(limit.where[0].values.front(), ParameterValue(std::string("edge-stereo")));
  EXPECT_EQ(limit.where[1].comparison, Comparison::kAtMost);
  EXPECT_EQ(limit.where[1].values.front(), ParameterValue(3.0));
  EXPECT_EQ(limit.where[2].values.size(), 2u);
}

TEST(LimitText, BlanksDoNotMatter) {
  const Limit limit = ParseLimit("rate( hit )>=0.98 where distance_m<4", 0.95);
  EXPECT_EQ(limit.metric.kind, Metric::Kind::kRate);
  EXPECT_FALSE(limit.is_upper);
  EXPECT_EQ(limit.value, 0.98);
  EXPECT_EQ(limit.confidence, 0.95);
  EXPECT_EQ(limit.where[0].comparison, Comparison::kLess);
}

TEST(LimitText, BaselinesAreRatiosOrDifferences) {
  const Limit ratio = ParseLimit("rmse(centroid_error_mm) <= 1.05 times baseline", 0.95);
  EXPECT_TRUE(ratio.to_baseline);
  EXPECT_EQ(ratio.value, 1.05);
  const Limit difference = ParseLimit("rate(hit) >= baseline - 0.02", 0.95);
  EXPECT_TRUE(difference.to_baseline);
  EXPECT_EQ(difference.value, -0.02);
  EXPECT_EQ(ParseLimit("rate(missed) <= baseline + 0.01", 0.95).value, 0.01);
  EXPECT_EQ(ParseLimit("rate(hit) >= baseline", 0.95).value, 0.0);
}

TEST(LimitText, FaultsNameTheWordAndWhatIsAllowed) {
  const auto fault = [](const std::string& text) -> std::string {
    try {
      ParseLimit(text, 0.95);
    } catch (const LimitTextError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(fault("q95(centroid_error_mm) <= 1"), HasSubstr("'q95'"));
  EXPECT_THAT(fault("p100(centroid_error_mm) <= 1"), HasSubstr("'p100'"));
  EXPECT_THAT(fault("p95(error) <= 1"), HasSubstr("centroid_error_x_mm"));
  EXPECT_THAT(fault("p95(centroid_error_mm <= 1"), HasSubstr("')'"));
  EXPECT_THAT(fault("p95(centroid_error_mm) < 1"), HasSubstr("<= or >="));
  EXPECT_THAT(fault("p95(centroid_error_mm) <= much"), HasSubstr("'much'"));
  EXPECT_THAT(fault("p95(centroid_error_mm) <= nan"), HasSubstr("'nan'"));
  EXPECT_THAT(fault("p95(centroid_error_mm) <="), HasSubstr("ends"));
  EXPECT_THAT(fault("rate(out_of_view) <= 0.1"), HasSubstr("false_alarm"));
  EXPECT_THAT(fault("rate(hit) >= 98"), HasSubstr("between 0 and 1"));
  EXPECT_THAT(fault("rate(hit) >= 0.9 where distanc_m < 1"), HasSubstr("distance_m"));
  EXPECT_THAT(fault("rate(hit) >= 0.9 where distance_m < near"), HasSubstr("distance_m"));
  EXPECT_THAT(fault("rate(hit) >= 0.9 where detector < a"), HasSubstr("no order"));
  EXPECT_THAT(fault("rate(hit) >= 0.9 with confidence 1"), HasSubstr("between 0 and 1"));
  EXPECT_THAT(fault("rate(hit) >= 0.9 or so"), HasSubstr("'or'"));
  EXPECT_THAT(fault("p95(centroid_error_mm) <= 2 times baseline"), HasSubstr("rmse"));
  EXPECT_THAT(fault("bias(centroid_error_z_mm) <= baseline + 1"), HasSubstr("rate"));
  EXPECT_THAT(fault(""), HasSubstr("ends"));
}

TEST(LimitFile, AllFaultsAreReportedWithTheirLines) {
  const std::string text =
      "studdy: paper\n"
      "false_alarm: 2\n"
      "limits:\n"
      "  - rate(hit) >= 0.9\n"
      "  - rate(hits) >= 0.9\n"
      "  - [1]\n";
  try {
    ReadLimitFile(YamlReader::FromText(text, "limits.yaml"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 4u) << error.what();
    EXPECT_THAT(error.what(), HasSubstr("limits.yaml:5:5: this limit has 'hits'"));
  }
}

TEST(LimitFile, TheFormerKeyIsReadToo) {
  const LimitFile file =
      ReadLimitFile(YamlReader::FromText("bounds: ['rate(hit) >= 0.9']\n", "bounds.yaml"));
  ASSERT_EQ(file.limits.size(), 1u);
  EXPECT_EQ(file.limits.front().value, 0.9);
}

TEST(LimitFile, DefaultsAreNamedInItsHeader) {
  const LimitFile file = ReadLimitFile(
      YamlReader::FromText("confidence: 0.8\nlimits: ['rate(hit) >= 0.9']\n", "limits.yaml"));
  EXPECT_EQ(file.false_alarm, 0.05);
  EXPECT_EQ(file.limits.front().confidence, 0.8);
  EXPECT_EQ(file.limits.front().line, 2);
  EXPECT_EQ(file.study, "");
}

}  // namespace
}  // namespace fenestra
