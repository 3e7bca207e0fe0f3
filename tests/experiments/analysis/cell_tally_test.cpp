#include "experiments/analysis/cell_tally.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "experiments/report/report.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

using testing::RandomHit;
using testing::Row;
using testing::RowWithError;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Every outcome of a scene with a target, and two hits.
std::vector<TrialRecord> MixedCell() {
  return {RowWithError(0, 0, Outcome::kHit, {0.03, -0.04, 0.12}),
          RowWithError(0, 1, Outcome::kHit, {0.01, 0.00, 0.08}),
          RowWithError(0, 2, Outcome::kGross, {0.0, 0.0, 0.5}),
          RowWithError(0, 3, Outcome::kWrongWindow, {3.0, 0.0, 0.0}),
          Row(0, 4, Outcome::kMissed),
          Row(0, 5, Outcome::kCrashed),
          RowWithError(0, 6, Outcome::kOutOfView, {0.9, 0.9, 0.9})};
}

TEST(CellTally, CountsHaveTheirDenominators) {
  const std::vector<TrialRecord> rows = MixedCell();
  const auto summaries = Summarise(rows);
  ASSERT_EQ(summaries.size(), 1u);
  const CellSummary& summary = summaries[0];
  EXPECT_EQ(summary.trials, 7);
  EXPECT_EQ(summary.in_view, 6);
  EXPECT_EQ(summary.without_target, 0);
  const MetricEstimate& hits = *summary.Find("hit_rate");
  EXPECT_EQ(hits.count, 2);
  EXPECT_EQ(hits.of, 6);
  EXPECT_EQ(hits.interval->lower, ClopperPearson(2, 6).lower);
  int attempts = 0;
  for (const Outcome outcome : {Outcome::kHit, Outcome::kGross, Outcome::kWrongWindow,
                                Outcome::kMissed, Outcome::kCrashed}) {
    attempts += summary.counts[outcome];
  }
  EXPECT_EQ(attempts, summary.in_view);
  EXPECT_EQ(summary.counts[Outcome::kOutOfView], 1);
}

TEST(CellTally, MomentsAreOverTheHitsAlone) {
  const std::vector<TrialRecord> rows = MixedCell();
  const auto summaries = Summarise(rows);
  const auto value = [&](const char* metric) { return summaries.at(0).Value(metric).value(); };
  // 2 ± 0.12 m rounds at 2^-52; the errors carry it: 1e-15 m, 1e-12 mm.
  EXPECT_NEAR(value("bias_x_mm"), 20.0, 1e-11);
  EXPECT_NEAR(value("bias_y_mm"), -20.0, 1e-11);
  EXPECT_NEAR(value("bias_z_mm"), 100.0, 1e-11);
  EXPECT_NEAR(value("rmse_mm"), 1e3 * std::sqrt((0.13 * 0.13 + 0.0065) / 2.0), 1e-11);
  EXPECT_NEAR(value("rmse_depth_mm"), 1e3 * std::sqrt((0.0144 + 0.0064) / 2.0), 1e-11);
  EXPECT_NEAR(value("rmse_across_mm"), 1e3 * std::sqrt((0.0025 + 0.0001) / 2.0), 1e-11);
  // s/√2 of {0.12, 0.08}.
  EXPECT_NEAR(*summaries.at(0).Find("bias_z_mm")->standard_error, 20.0, 1e-11);
}

TEST(CellTally, DepthAndAcrossMakeUpTheWhole) {
  std::vector<TrialRecord> rows;
  for (int trial = 0; trial < 50; ++trial) rows.push_back(RandomHit(0, trial));
  const CellSummary summary = Summarise(rows).at(0);
  const double all = summary.Value("rmse_mm").value();
  const double depth = summary.Value("rmse_depth_mm").value();
  const double across = summary.Value("rmse_across_mm").value();
  // RMSE² of 100 mm² from sums of 50 terms: 50 ε 100 ≈ 1e-12.
  EXPECT_NEAR(all * all, depth * depth + across * across, 1e-11);
}

TEST(CellTally, BoundsAreOverTheHitsThatTheErrorsAreOver) {
  std::vector<TrialRecord> rows = MixedCell();
  const Eigen::Vector3d variances(0.01, 0.02, 0.06);
  double scale = 1.0;
  for (TrialRecord& row : rows) {
    // Of those that are not hits, nothing must come through.
    const bool hit = row.score.outcome == Outcome::kHit;
    row.bound_C = Eigen::Matrix3d(variances.asDiagonal()) * (hit ? scale : 1e6);
    if (hit) scale += 2.0;  // 1 and 3: 2 in the mean.
  }
  const CellSummary summary = Summarise(rows).at(0);
  ASSERT_TRUE(summary.bounds.has_value());
  EXPECT_NEAR(summary.bounds->all, std::sqrt(0.18), 1e-14);
  EXPECT_NEAR(summary.bounds->depth, std::sqrt(0.12), 1e-14);
  EXPECT_NEAR(summary.bounds->across, std::sqrt(0.06), 1e-14);
  EXPECT_NEAR(summary.Value("rmse_over_bound").value(),
              1e-3 * summary.Value("rmse_mm").value() / std::sqrt(0.18), 1e-13);
  EXPECT_NEAR(summary.Value("rmse_depth_over_bound").value(),
              1e-3 * summary.Value("rmse_depth_mm").value() / std::sqrt(0.12), 1e-13);
  // One hit without a bound: the two are no longer over the same trials.
  for (TrialRecord& row : rows) {
    if (row.score.outcome == Outcome::kHit) row.bound_C.reset();
    if (!row.bound_C) break;
  }
  const CellSummary unbounded = Summarise(rows).at(0);
  EXPECT_FALSE(unbounded.bounds.has_value());
  EXPECT_FALSE(unbounded.Value("rmse_over_bound").has_value());
}

TEST(CellTally, QuantilesAreOverAllAttemptsWithInfinityForThoseWithoutEstimate) {
  // The six attempts: 0.13, 0.081, 0.5, 3, inf, inf. The third smallest is the median.
  const std::vector<TrialRecord> rows = MixedCell();
  const auto summaries = Summarise(rows);
  EXPECT_NEAR(summaries.at(0).Value("p50_error_mm").value(), 500.0, 1e-11);
  EXPECT_EQ(summaries.at(0).Value("p95_error_mm").value(), kInfinity);
}

TEST(CellTally, DecliningTheHardTrialsDoesNotImproveTheQuantile) {
  std::vector<TrialRecord> honest;
  for (int trial = 0; trial < 20; ++trial) {
    const bool hard = trial < 2;
    honest.push_back(RowWithError(0, trial, hard ? Outcome::kGross : Outcome::kHit,
                                  {0.0, 0.0, hard ? 0.4 : 0.01}));
  }
  std::vector<TrialRecord> declining = honest;
  for (int trial = 0; trial < 2; ++trial) declining[trial] = Row(0, trial, Outcome::kMissed);
  EXPECT_GT(Summarise(declining).at(0).Value("p95_error_mm").value(),
            Summarise(honest).at(0).Value("p95_error_mm").value());
}

TEST(CellTally, ScenesWithoutATargetHaveTheirOwnDenominator) {
  std::vector<TrialRecord> rows = {Row(0, 0, Outcome::kClear), Row(0, 1, Outcome::kFalseAlarm),
                                   Row(0, 2, Outcome::kClear), Row(0, 3, Outcome::kCrashed)};
  rows[3].score.truth_p_CO.reset();
  const CellSummary summary = Summarise(rows).at(0);
  EXPECT_EQ(summary.in_view, 0);
  EXPECT_EQ(summary.without_target, 4);
  EXPECT_EQ(summary.Find("false_alarm_rate")->count, 1);
  EXPECT_EQ(summary.Find("false_alarm_rate")->of, 4);
  EXPECT_FALSE(summary.Value("rmse_mm").has_value());
  EXPECT_FALSE(summary.Value("p95_error_mm").has_value());
}

TEST(CellTally, DoesNotDependOnTheOrderOfTheRows) {
  std::vector<TrialRecord> rows;
  for (int cell = 0; cell < 3; ++cell) {
    for (int trial = 0; trial < 10; ++trial) {
      for (const char* detector : {"b", "a"}) rows.push_back(RandomHit(cell, trial, detector));
    }
  }
  const auto expected = Summarise(rows);
  ASSERT_EQ(expected.size(), 6u);
  EXPECT_EQ(expected[0].detector, "a");
  EXPECT_EQ(expected[1].detector, "b");
  EXPECT_EQ(expected[2].cell, 1);
  // The CSV has every figure with all its digits.
  const RandomStream stream(5);
  for (uint64_t round = 0; round < 20; ++round) {
    for (size_t i = rows.size() - 1; i > 0; --i) {
      const double u = stream.Child("round", round).Uniform(i);
      std::swap(rows[i], rows[static_cast<size_t>(u * static_cast<double>(i + 1))]);
    }
    EXPECT_EQ(SummaryCsv(Summarise(rows)), SummaryCsv(expected));
  }
}

TEST(CellTally, ReasonsAreOrderedByOutcomeAndFrequency) {
  std::vector<TrialRecord> rows;
  for (int trial = 0; trial < 6; ++trial) rows.push_back(Row(0, trial, Outcome::kMissed));
  rows[0].score.reason = "few_corners";
  rows[5] = Row(0, 5, Outcome::kCrashed);
  const auto reasons = Summarise(rows).at(0).reasons;
  ASSERT_EQ(reasons.size(), 3u);
  EXPECT_EQ(reasons[0].reason, "no_contour");
  EXPECT_EQ(reasons[0].count, 4);
  EXPECT_EQ(reasons[1].reason, "few_corners");
  EXPECT_EQ(reasons[2].outcome, Outcome::kCrashed);
}

TEST(CellTally, TimesAreMediansOverTrialsThatDidNotCrash) {
  std::vector<TrialRecord> rows;
  for (int trial = 0; trial < 4; ++trial) {
    rows.push_back(Row(0, trial, trial == 3 ? Outcome::kCrashed : Outcome::kMissed));
    rows.back().stages = {{"match", 0.1 * (trial + 1)}};
    if (trial == 2) rows.back().stages.push_back({"contour", 0.5});
  }
  const CellSummary summary = Summarise(rows).at(0);
  EXPECT_EQ(summary.timed, 3);
  EXPECT_EQ(summary.Value("p50_time_ms").value(), 200.0);
  ASSERT_EQ(summary.stage_medians.size(), 2u);
  EXPECT_EQ(summary.stage_medians[0].median_s, 0.2);
  EXPECT_EQ(summary.stage_medians[1].stage, "contour");
  EXPECT_EQ(summary.stage_medians[1].median_s, 0.5);
}

TEST(CellTally, ARowThatOccursTwiceIsAFault) {
  const std::vector<TrialRecord> rows = {Row(0, 1, Outcome::kMissed), Row(0, 1, Outcome::kMissed)};
  EXPECT_THROW(Summarise(rows), std::logic_error);
}

}  // namespace
}  // namespace fenestra
