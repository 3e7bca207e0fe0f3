#include "experiments/check/estimation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random/random_stream.h"
#include "experiments/check/limit_text.h"
#include "experiments/statistics/moments.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

using testing::Row;
using testing::RowWithError;

// Rows that each are a cluster of their own, or of which so many share one.
std::vector<SelectedRow> Selected(const std::vector<TrialRecord>& rows, int rows_per_cluster = 1) {
  std::vector<SelectedRow> selected;
  for (size_t i = 0; i < rows.size(); ++i) {
    SelectedRow row{.row = &rows[i], .now = RowContext().Of(rows[i])};
    row.now.cluster = {.replicate = static_cast<int>(i) / rows_per_cluster};
    selected.push_back(row);
  }
  return selected;
}

std::optional<Estimation> EstimateOf(const std::string& limit, const std::vector<TrialRecord>& rows,
                                     int rows_per_cluster = 1) {
  return Estimate(ParseLimit(limit, 0.95), Selected(rows, rows_per_cluster));
}

std::vector<TrialRecord> Hits(int hits, int misses) {
  std::vector<TrialRecord> rows;
  for (int i = 0; i < hits; ++i) rows.push_back(RowWithError(0, i, Outcome::kHit, {0.01, 0, 0}));
  for (int i = 0; i < misses; ++i) rows.push_back(Row(0, hits + i, Outcome::kMissed));
  return rows;
}

// Errors of N(mean, 10²) mm in depth.
std::vector<TrialRecord> NormalHits(int count, double mean_mm, uint64_t seed) {
  std::vector<TrialRecord> rows;
  const RandomStream stream(seed);
  for (int i = 0; i < count; ++i) {
    const double z_mm = mean_mm + 10.0 * stream.Normal(static_cast<uint64_t>(i));
    rows.push_back(RowWithError(0, i, Outcome::kHit, {0.0, 0.0, 1e-3 * z_mm}));
  }
  return rows;
}

TEST(Estimation, ARatesLimitsAreClopperPearsonsWhereRowsAreIndependent) {
  const auto rate = EstimateOf("rate(hit) >= 0.9", Hits(33, 7));
  ASSERT_TRUE(rate.has_value());
  EXPECT_EQ(rate->rows, 40);
  EXPECT_EQ(rate->limits.clusters, 40);
  EXPECT_EQ(rate->limits.estimate, 33.0 / 40.0);
  const Interval exact = ClopperPearson(33, 40, 0.90);  // Two-sided: 5 % on either side.
  EXPECT_NEAR(rate->limits.lower(0.95, 1.0), exact.lower, 1e-12);
  EXPECT_NEAR(rate->limits.upper(0.95, 1.0), exact.upper, 1e-12);
}

TEST(Estimation, RowsThatRepeatEachOtherCountOnce) {
  std::vector<TrialRecord> repeated;
  for (const TrialRecord& row : Hits(33, 7)) repeated.insert(repeated.end(), 4, row);
  const auto clustered = EstimateOf("rate(hit) >= 0.9", repeated, 4);
  const auto careless = EstimateOf("rate(hit) >= 0.9", repeated, 1);
  const auto once = EstimateOf("rate(hit) >= 0.9", Hits(33, 7));
  EXPECT_EQ(clustered->limits.clusters, 40);
  EXPECT_NEAR(clustered->limits.lower(0.95, 1.0), once->limits.lower(0.95, 1.0), 0.02);
  EXPECT_GT(careless->limits.lower(0.95, 1.0), once->limits.lower(0.95, 1.0) + 0.03);
}

TEST(Estimation, MoreRowsOfTheSameScatterAreMoreCertain) {
  for (const char* limit : {"rate(hit) >= 0.5", "rmse(centroid_error_mm) <= 20",
                            "bias(centroid_error_z_mm) <= 5", "p50(centroid_error_mm) <= 9"}) {
    const auto some = EstimateOf(limit, NormalHits(60, 3.0, 1));
    ASSERT_TRUE(some.has_value()) << limit;
    const double width = some->limits.upper(0.95, 1.0) - some->limits.lower(0.95, 1.0);
    EXPECT_LT(some->limits.upper(0.95, 4.0) - some->limits.lower(0.95, 4.0), 0.7 * width + 1e-12)
        << limit;
    EXPECT_LE(some->limits.lower(0.99, 1.0), some->limits.lower(0.95, 1.0)) << limit;
  }
}

// p80 ≤ 15 says that the share within 15 is at least 0.8.
TEST(Estimation, AQuantileIsAShareOfWhatIsWithinItsLimit) {
  const auto quantile = EstimateOf("p80(centroid_error_mm) <= 15", Hits(30, 10));
  ASSERT_TRUE(quantile.has_value());
  EXPECT_EQ(quantile->limits.estimate, 0.75) << "a miss is within no limit";
  EXPECT_EQ(quantile->limits.limit, 0.8);
  EXPECT_FALSE(quantile->limits.is_upper);
  // At the limit both senses hold.
  EXPECT_EQ(EstimateOf("p80(centroid_error_mm) <= 10", Hits(30, 10))->limits.estimate, 0.75);
  EXPECT_EQ(EstimateOf("p80(centroid_error_mm) >= 10", Hits(30, 10))->limits.estimate, 0.0);
}

// Student's t: x̄ ± t s/√n.
TEST(Estimation, ABiassLimitsAreStudents) {
  const auto bias = EstimateOf("bias(centroid_error_z_mm) <= 5", NormalHits(16, 3.0, 2));
  ASSERT_TRUE(bias.has_value());
  std::vector<double> values;
  for (const TrialRecord& row : NormalHits(16, 3.0, 2)) {
    values.push_back(1e3 * row.score.CentroidError_C()->z());
  }
  double mean = 0.0;
  for (const double x : values) mean += x / 16.0;
  double variance = 0.0;
  for (const double x : values) variance += (x - mean) * (x - mean) / 15.0;
  EXPECT_NEAR(bias->limits.estimate, mean, 1e-9);
  // The 95 % quantile of t with 15 degrees of freedom is 1.753.
  EXPECT_NEAR(bias->limits.upper(0.95, 1.0), mean + 1.753 * std::sqrt(variance / 16.0),
              1e-3 * 10.0);
  EXPECT_NEAR(bias->limits.lower(0.95, 1.0), mean - 1.753 * std::sqrt(variance / 16.0),
              1e-3 * 10.0);
}

TEST(Estimation, AnRmsesLimitsAreOnTheWrongSideAboutAsOftenAsStated) {
  // 10 mm in truth; of 400 samples of 60 rows 5 % above, to first order. Four standard deviations
  // of a binomial share are 4.4 %, and 3 % are the first order's.
  int wrong = 0;
  constexpr int kSamples = 400;
  for (uint64_t i = 0; i < kSamples; ++i) {
    const auto rmse = EstimateOf("rmse(centroid_error_z_mm) <= 10", NormalHits(60, 0.0, 100 + i));
    wrong += rmse->limits.upper(0.95, 1.0) < 10.0 ? 1 : 0;
  }
  EXPECT_LT(wrong, kSamples * (0.05 + 0.044 + 0.03));
}

TEST(Estimation, AgainstABaselineEqualRowsHaveTheRatioOneWithoutAnyDoubt) {
  const std::vector<TrialRecord> rows = NormalHits(30, 0.0, 5);
  std::vector<SelectedRow> selected = Selected(rows);
  for (SelectedRow& row : selected) row.before = row.now;
  Limit limit = ParseLimit("rmse(centroid_error_mm) <= 1.1", 0.95);
  limit.to_baseline = true;
  const auto ratio = Estimate(limit, selected);
  ASSERT_TRUE(ratio.has_value());
  EXPECT_NEAR(ratio->limits.estimate, 1.0, 1e-12);
  EXPECT_NEAR(ratio->limits.upper(0.95, 1.0), 1.0, 1e-9);
  limit = ParseLimit("rate(hit) >= 0.9", 0.95);
  limit.to_baseline = true;
  const auto difference = Estimate(limit, selected);
  EXPECT_EQ(difference->limits.estimate, 0.0);
  EXPECT_LT(difference->limits.lower(0.95, 1.0), 0.0);
  EXPECT_GT(difference->limits.upper(0.95, 1.0), 0.0);
}

TEST(Estimation, WithoutARowThatCountsThereIsNone) {
  const std::vector<TrialRecord> misses = Hits(0, 5);
  EXPECT_FALSE(EstimateOf("rmse(centroid_error_mm) <= 10", misses));
  EXPECT_FALSE(EstimateOf("bias(centroid_error_z_mm) <= 10", misses));
  EXPECT_TRUE(EstimateOf("rate(hit) >= 0.5", misses));
  EXPECT_FALSE(EstimateOf("rate(false_alarm) <= 0.1", misses)) << "no scene without a target";
  EXPECT_FALSE(EstimateOf("rate(hit) >= 0.5", {Row(0, 0, Outcome::kOutOfView)}));
}

}  // namespace
}  // namespace fenestra
