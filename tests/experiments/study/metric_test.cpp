#include "experiments/study/metric.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace fenestra {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

TEST(Metric, EveryNameStandsForOneMetric) {
  std::set<std::string> names;
  for (const NamedMetric& named : Metrics()) {
    EXPECT_TRUE(names.insert(named.name).second) << named.name;
    EXPECT_EQ(FindMetric(named.name), named.metric) << named.name;
    for (const NamedMetric& other : Metrics()) {
      EXPECT_EQ(named.metric == other.metric, named.name == other.name) << other.name;
    }
  }
  EXPECT_FALSE(FindMetric("hitrate").has_value());
}

// Files of users name these: a study's `until` and `envelope`, a column of a table.
TEST(Metric, NamesThatFilesHaveStay) {
  for (const char* name :
       {"hit_rate", "gross_rate", "wrong_window_rate", "missed_rate", "crashed_rate",
        "out_of_view_rate", "false_alarm_rate", "clear_rate", "bias_x_mm", "bias_y_mm", "bias_z_mm",
        "rmse_mm", "rmse_depth_mm", "rmse_across_mm", "p50_error_mm", "p95_error_mm",
        "rmse_over_bound", "rmse_depth_over_bound"}) {
    EXPECT_TRUE(FindMetric(name).has_value()) << name;
  }
  for (const char* name :
       {"hit_rate", "false_alarm_rate", "p50_error_mm", "p95_error_mm", "bias_mm", "rmse_mm"}) {
    EXPECT_THAT(StoppingMetrics(), Contains(name));
  }
  EXPECT_THAT(MetricsOfTarget("bias_mm"), ElementsAre("bias_x_mm", "bias_y_mm", "bias_z_mm"));
  EXPECT_TRUE(MetricsOfTarget("p50_time_ms").empty());
  for (const char* name : {"hit_rate", "p50_error_mm", "p95_error_mm"}) {
    EXPECT_THAT(RequirementMetrics(), Contains(name));
  }
  EXPECT_THAT(RequirementMetrics(), Not(Contains("missed_rate")));
}

TEST(Metric, ANameEndsWithTheUnitOfItsValue) {
  for (const NamedMetric& named : Metrics()) {
    const std::string unit = UnitOf(named.metric);
    EXPECT_EQ(named.name.ends_with("_mm"), unit == "mm") << named.name;
    EXPECT_EQ(named.name.ends_with("_ms"), unit == "ms") << named.name;
  }
  EXPECT_EQ(ColumnOf("rmse_mm", "_lower95"), "rmse_lower95_mm");
  EXPECT_EQ(ColumnOf("hit_rate", "_lower95"), "hit_rate_lower95");
}

TEST(Metric, DecliningTheHardAttemptsPaysNothing) {
  // What a detector could better by giving no estimate is over the hits, and says so.
  for (const NamedMetric& named : Metrics()) {
    const bool of_errors = named.metric.quantity != Quantity::kTime &&
                           named.metric.quantity != Quantity::kErrorOverBound &&
                           named.metric.quantity != Quantity::kNormalisedSquare;
    if (named.metric.kind != Metric::Kind::kQuantile || !of_errors) continue;
    EXPECT_EQ(RowsOf(named.metric), CountedRows::kAttempts) << named.name;
  }
  EXPECT_EQ(RowsOf(*FindMetric("rmse_mm")), CountedRows::kHits);
  EXPECT_EQ(RowsOf(*FindMetric("hit_rate_5pct")), CountedRows::kAttempts);
  EXPECT_EQ(RowsOf(*FindMetric("false_alarm_rate")), CountedRows::kWithoutTarget);
  EXPECT_EQ(RowsOf(*FindMetric("out_of_view_rate")), CountedRows::kWithTarget);
  EXPECT_EQ(RowsOf(*FindMetric("rms_error_over_bound")), CountedRows::kBoundedHits);
  EXPECT_EQ(RowsOf(*FindMetric("within_covariance_rate")), CountedRows::kHitsWithCovariance);
  EXPECT_EQ(RowsOf(*FindMetric("p50_time_ms")), CountedRows::kTimed);
}

}  // namespace
}  // namespace fenestra
