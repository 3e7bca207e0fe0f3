#include "experiments/analysis/paired_ratio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/io/input_error.h"
#include "experiments/report/paired_ratio_report.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

constexpr double kInfiniteRatio = std::numeric_limits<double>::infinity();

// Lengths of normal 3-vectors; the condition's are `ratio` times as long, and partly its own.
std::vector<ErrorPair> Pairs(double ratio, double own, int count, const RandomStream& stream) {
  std::vector<ErrorPair> pairs;
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<uint64_t>(6 * i);
    Eigen::Vector3d a;
    Eigen::Vector3d b;
    for (int k = 0; k < 3; ++k) {
      const auto j = n + static_cast<uint64_t>(2 * k);
      b[k] = stream.Normal(j);
      a[k] = std::sqrt(1.0 - own * own) * b[k] + own * stream.Normal(j + 1);
    }
    pairs.push_back({ratio * a.norm(), b.norm(), true, true});
  }
  return pairs;
}

TEST(PairedRatioTest, EqualSamplesHaveTheRatioOneWithoutAnyDoubt) {
  const std::vector<ErrorPair> pairs = Pairs(1.0, 0.0, 40, RandomStream(1));
  const PairedRatios ratios = RatiosOf({&pairs, 1}, RandomStream(2));
  EXPECT_EQ(ratios.pairs, 40);
  for (const Ratio& ratio : {ratios.rmse, ratios.p95_error}) {
    EXPECT_DOUBLE_EQ(ratio.value, 1.0);
    EXPECT_DOUBLE_EQ(ratio.interval90.lower, 1.0);
    EXPECT_DOUBLE_EQ(ratio.interval90.upper, 1.0);
  }
}

TEST(PairedRatioTest, IntervalsOfTheRmseCoverTheTruthAsOftenAsTheySay) {
  // 200 samples; a percentile interval of 60 pairs covers a little less than its 90 %. Between 82
  // and 96 %: four standard deviations, 0.021, around 0.89.
  constexpr int kSamples = 200;
  int covered = 0;
  int covered_by_a_wrong_one = 0;
  for (uint64_t k = 0; k < kSamples; ++k) {
    const std::vector<ErrorPair> pairs = Pairs(1.1, 0.5, 60, RandomStream(3).Child("sample", k));
    const Interval interval = RatiosOf({&pairs, 1}, RandomStream(4)).rmse.interval90;
    if (interval.lower <= 1.1 && 1.1 <= interval.upper) ++covered;
    if (interval.lower <= 1.0 && 1.0 <= interval.upper) ++covered_by_a_wrong_one;
  }
  EXPECT_GE(covered, 164);
  EXPECT_LE(covered, 192);
  EXPECT_LT(covered_by_a_wrong_one, 120);
}

TEST(PairedRatioTest, SeveralCellsCountByTheirGeometricMean) {
  const std::vector<std::vector<ErrorPair>> cells = {Pairs(2.0, 0.0, 30, RandomStream(5)),
                                                     Pairs(0.5, 0.0, 30, RandomStream(6))};
  const PairedRatios ratios = RatiosOf(cells, RandomStream(7));
  EXPECT_EQ(ratios.pairs, 60);
  EXPECT_NEAR(ratios.rmse.value, 1.0, 1e-12);
  EXPECT_NEAR(ratios.p95_error.value, 1.0, 1e-12);
}

// Cells that share their replicates are no independent witnesses: eight of them with equal pairs
// tell no more than one.
TEST(PairedRatioTest, CellsThatShareReplicatesDrawThemTogether) {
  std::vector<ErrorPair> pairs = Pairs(1.1, 0.5, 60, RandomStream(10));
  const Interval forgetful =
      RatiosOf(std::vector<std::vector<ErrorPair>>(8, pairs), RandomStream(4)).rmse.interval90;
  for (size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].cluster = ClusterKey{.replicate = static_cast<int>(i)};
  }
  const Interval one = RatiosOf({&pairs, 1}, RandomStream(4)).rmse.interval90;
  const Interval eight =
      RatiosOf(std::vector<std::vector<ErrorPair>>(8, pairs), RandomStream(4)).rmse.interval90;
  EXPECT_DOUBLE_EQ(eight.lower, one.lower);
  EXPECT_DOUBLE_EQ(eight.upper, one.upper);
  // √8 narrower, as if each cell had luck of its own.
  EXPECT_LT(forgetful.upper - forgetful.lower, 0.5 * (one.upper - one.lower));
}

TEST(PairedRatioTest, MissesCountInTheQuantileAndNotInTheRmse) {
  std::vector<ErrorPair> pairs = Pairs(1.0, 0.0, 40, RandomStream(8));
  for (size_t i = 0; i < 4; ++i) pairs[i] = {kInfiniteRatio, pairs[i].base_error_m, false, true};
  const PairedRatios ratios = RatiosOf({&pairs, 1}, RandomStream(9));
  EXPECT_TRUE(std::isfinite(ratios.rmse.value));
  EXPECT_TRUE(std::isnan(ratios.p95_error.value));
}

TEST(PairedRatioTest, CellsThatDifferInTheFactorAloneArePaired) {
  std::vector<TrialRecord> rows;
  int cell = 0;
  for (const double distance_m : {2.0, 3.0}) {
    for (const char* model : {"parametric", "speckle"}) {
      for (int trial = 0; trial < 5; ++trial) {
        const double error_m = 0.001 * (trial + 1) * (model[0] == 's' ? 3.0 : 1.0);
        TrialRecord row = testing::RowWithError(cell, trial, Outcome::kHit, {error_m, 0.0, 0.0});
        row.levels = {{"distance_m", distance_m}, {"rgbd_depth_model", std::string(model)}};
        rows.push_back(row);
      }
      ++cell;
    }
  }
  rows.back().score.outcome = Outcome::kOutOfView;
  const std::vector<PairedCells> pairs = PairsBy(rows, "rgbd_depth_model");
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].level, "speckle");
  EXPECT_EQ(pairs[0].base_level, "parametric");
  EXPECT_EQ(pairs[0].pairs.size(), 5u);
  EXPECT_EQ(pairs[1].pairs.size(), 4u);
  EXPECT_NEAR(RatiosOf({&pairs[0].pairs, 1}, RandomStream(1)).rmse.value, 3.0, 1e-9);
  const std::string table = PairedRatioTable(pairs, "rgbd_depth_model", RandomStream(1));
  EXPECT_NE(table.find("3.00 [3.00, 3.00]"), std::string::npos) << table;
  EXPECT_NE(table.find("geometric mean"), std::string::npos) << table;
  EXPECT_THROW(PairsBy(rows, "azimuth_deg"), InputError);
}

}  // namespace
}  // namespace fenestra
