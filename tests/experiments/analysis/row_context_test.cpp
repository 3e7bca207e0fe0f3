#include "experiments/analysis/row_context.h"

#include <gtest/gtest.h>

#include "experiments/statistics/intervals.h"
#include "tests/experiments/study_file/study_text.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

using testing::RowWithError;

const std::string kContextStudy =
    "name: test\nsensors: [stereo]\nrepetitions: 30\n"
    "factors:\n  distance_m: [2, 3]\n  window_height_m: 0.8\n  yaw_deg: {uniform: [-2, 2]}\n";

RowContext ContextOf(const std::string& text) {
  const Study study = ReadText(text);
  return RowContext(study, Cells(study));
}

MetricRow Of(const RowContext& context, int cell, int trial) {
  return context.Of(RowWithError(cell, trial, Outcome::kHit, {0.0, 0.0, 0.01}));
}

TEST(RowContext, CellsShareTheirReplicatesUnlessTheyAreIndependent) {
  const RowContext shared = ContextOf(kContextStudy);
  EXPECT_EQ(Of(shared, 0, 7).cluster, Of(shared, 1, 7).cluster);
  EXPECT_NE(Of(shared, 0, 7).cluster, Of(shared, 0, 8).cluster);
  const RowContext apart = ContextOf(kContextStudy + "independent_cells: true\n");
  EXPECT_NE(Of(apart, 0, 7).cluster, Of(apart, 1, 7).cluster);
  EXPECT_EQ(Of(apart, 0, 7).cluster, Of(apart, 0, 7).cluster);
}

TEST(RowContext, OfASensitivityDesignTwoTrialsOfARowAreIndependent) {
  // Causes: noise, calibration and pose, so five trials a row.
  const RowContext context = ContextOf(kContextStudy + "design: sensitivity\n");
  for (int trial = 0; trial < 30; ++trial) {
    EXPECT_EQ(Of(context, 0, trial).is_independent, trial % 5 <= 1) << trial;
  }
  EXPECT_NE(Of(context, 0, 5).cluster, Of(context, 0, 6).cluster);
  EXPECT_EQ(Of(context, 0, 5).cluster.replicate, 1);
  EXPECT_EQ(Of(context, 0, 5).cluster, Of(context, 1, 5).cluster);
}

TEST(RowContext, TheSideIsTheSmallerOneOfTheTrialsOwnWindow) {
  const RowContext context = ContextOf(kContextStudy);
  EXPECT_DOUBLE_EQ(*Of(context, 0, 0).side_m, 0.8);  // The width is 1 m by default.
  TrialRecord narrow = RowWithError(0, 0, Outcome::kHit, {0.0, 0.0, 0.01});
  narrow.drawn = {{"window_width_m", 0.5}};
  EXPECT_DOUBLE_EQ(*context.Of(narrow).side_m, 0.5);
  EXPECT_FALSE(Of(RowContext(), 0, 0).side_m.has_value());
  EXPECT_DOUBLE_EQ(
      *Of(RowContext(std::map<std::pair<int, int>, double>{{{0, 3}, 1.5}}), 0, 3).side_m, 1.5);
}

TEST(RowContext, CellsThatMayStopEarlyNeedMoreConfidence) {
  EXPECT_EQ(ContextOf(kContextStudy).Confidence(0), 0.95);
  const int looks = static_cast<int>(Looks(20, 30).size());
  EXPECT_EQ(ContextOf(kContextStudy + "until: {hit_rate: 0.1}\n").Confidence(1),
            LookConfidence(0.95, looks));
}

TEST(RowContext, TheNormalisedSquareIsThatOfTheStatedCovariance) {
  TrialRecord row = RowWithError(0, 0, Outcome::kHit, {0.01, 0.0, 0.02});
  EXPECT_FALSE(RowContext().Of(row).normalised_square.has_value());
  row.score.estimate->covariance_C = Eigen::Vector3d(1e-4, 1e-4, 4e-4).asDiagonal();
  EXPECT_NEAR(*RowContext().Of(row).normalised_square, 2.0, 1e-9);
  row.score.estimate->covariance_C = -Eigen::Matrix3d::Identity();
  EXPECT_FALSE(RowContext().Of(row).normalised_square.has_value());
}

}  // namespace
}  // namespace fenestra
