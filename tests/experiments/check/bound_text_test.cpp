#include "experiments/check/bound_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "experiments/check/bound_file.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;

TEST(BoundText, EveryPartIsRead) {
  const Bound bound = ParseBound(
      "p99.9(centroid_error_z_mm) <= 15 with confidence 0.9 in each cell where detector = "
      "edge-stereo and distance_m <= 3 and scene in [facade, paper_target]",
      0.95);
  EXPECT_EQ(bound.metric.kind, Metric::Kind::kQuantile);
  EXPECT_DOUBLE_EQ(bound.metric.level, 0.999);
  EXPECT_EQ(bound.metric.quantity, Quantity::kErrorZ);
  EXPECT_TRUE(bound.is_upper);
  EXPECT_EQ(bound.limit, 15.0);
  EXPECT_EQ(bound.confidence, 0.9);
  EXPECT_TRUE(bound.in_each_cell);
  EXPECT_FALSE(bound.to_baseline);
  ASSERT_EQ(bound.where.size(), 3u);
  EXPECT_EQ(bound.where[0].values.front(), ParameterValue(std::string("edge-stereo")));
  EXPECT_EQ(bound.where[1].comparison, Comparison::kAtMost);
  EXPECT_EQ(bound.where[1].values.front(), ParameterValue(3.0));
  EXPECT_EQ(bound.where[2].values.size(), 2u);
}

TEST(BoundText, BlanksDoNotMatter) {
  const Bound bound = ParseBound("rate( hit )>=0.98 where distance_m<4", 0.95);
  EXPECT_EQ(bound.metric.kind, Metric::Kind::kRate);
  EXPECT_FALSE(bound.is_upper);
  EXPECT_EQ(bound.limit, 0.98);
  EXPECT_EQ(bound.confidence, 0.95);
  EXPECT_EQ(bound.where[0].comparison, Comparison::kLess);
}

TEST(BoundText, BaselinesAreRatiosOrDifferences) {
  const Bound ratio = ParseBound("rmse(centroid_error_mm) <= 1.05 times baseline", 0.95);
  EXPECT_TRUE(ratio.to_baseline);
  EXPECT_EQ(ratio.limit, 1.05);
  const Bound difference = ParseBound("rate(hit) >= baseline - 0.02", 0.95);
  EXPECT_TRUE(difference.to_baseline);
  EXPECT_EQ(difference.limit, -0.02);
  EXPECT_EQ(ParseBound("rate(missed) <= baseline + 0.01", 0.95).limit, 0.01);
  EXPECT_EQ(ParseBound("rate(hit) >= baseline", 0.95).limit, 0.0);
}

TEST(BoundText, FaultsNameTheWordAndWhatIsAllowed) {
  const auto fault = [](const std::string& text) -> std::string {
    try {
      ParseBound(text, 0.95);
    } catch (const BoundTextError& error) {
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

TEST(BoundFile, AllFaultsAreReportedWithTheirLines) {
  const std::string text =
      "studdy: paper\n"
      "false_alarm: 2\n"
      "bounds:\n"
      "  - rate(hit) >= 0.9\n"
      "  - rate(hits) >= 0.9\n"
      "  - [1]\n";
  try {
    ReadBoundFile(YamlReader::FromText(text, "bounds.yaml"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 4u) << error.what();
    EXPECT_THAT(error.what(), HasSubstr("bounds.yaml:5:5: this bound has 'hits'"));
  }
}

TEST(BoundFile, DefaultsAreNamedInItsHeader) {
  const BoundFile file = ReadBoundFile(
      YamlReader::FromText("confidence: 0.8\nbounds: ['rate(hit) >= 0.9']\n", "bounds.yaml"));
  EXPECT_EQ(file.false_alarm, 0.05);
  EXPECT_EQ(file.bounds.front().confidence, 0.8);
  EXPECT_EQ(file.bounds.front().line, 2);
  EXPECT_EQ(file.study, "");
}

}  // namespace
}  // namespace fenestra
