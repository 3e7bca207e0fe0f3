#include "experiments/analysis/figure_tally.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fenestra {
namespace {

TrialRecord Row(Outcome outcome, const Eigen::Vector3d& error_C = Eigen::Vector3d::Zero()) {
  TrialRecord row;
  row.score.outcome = outcome;
  const bool scene_is_empty = outcome == Outcome::kFalseAlarm || outcome == Outcome::kClear;
  if (!scene_is_empty) row.score.truth_p_CO = Eigen::Vector3d(0, 0, 3);
  if (outcome == Outcome::kHit || outcome == Outcome::kGross) {
    WindowEstimate estimate;
    estimate.p_CO = Eigen::Vector3d(0, 0, 3) + error_C;
    row.score.estimate = estimate;
  }
  return row;
}

const FigureEstimate* Find(const std::vector<FigureEstimate>& figures, const std::string& name) {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&name](const auto& f) { return f.figure == name; });
  return found == figures.end() ? nullptr : &*found;
}

TEST(FigureTally, HasTheRateOfEveryOutcomeWithItsDenominator) {
  FigureTally tally;
  for (int i = 0; i < 6; ++i) tally.Add(Row(Outcome::kHit, {0.001 * i, 0, 0.01}));
  tally.Add(Row(Outcome::kGross, {0, 0, 1}));
  tally.Add(Row(Outcome::kMissed));
  tally.Add(Row(Outcome::kOutOfView));
  tally.Add(Row(Outcome::kFalseAlarm));
  tally.Add(Row(Outcome::kClear));
  const auto figures = tally.Figures(0.95);
  const auto expect = [&](const char* name, double value, int of) {
    const FigureEstimate* figure = Find(figures, name);
    ASSERT_NE(figure, nullptr) << name;
    EXPECT_EQ(figure->value, value) << name;
    EXPECT_EQ(figure->of, of) << name;
    EXPECT_EQ(figure->interval->lower,
              ClopperPearson(static_cast<int>(std::lround(value * of)), of).lower);
  };
  expect("hit_rate", 0.75, 8);
  expect("gross_rate", 0.125, 8);
  expect("wrong_window_rate", 0.0, 8);
  expect("missed_rate", 0.125, 8);
  expect("crashed_rate", 0.0, 8);
  expect("out_of_view_rate", 1.0 / 9.0, 9);
  expect("false_alarm_rate", 0.5, 2);
  expect("clear_rate", 0.5, 2);
}

TEST(FigureTally, ErrorsAreInMillimetresOverTheirOwnTrials) {
  FigureTally tally;
  for (int i = 0; i < 10; ++i) tally.Add(Row(Outcome::kHit, {0, 0, 0.010 + 0.001 * i}));
  for (int i = 0; i < 10; ++i) tally.Add(Row(Outcome::kMissed));
  const auto figures = tally.Figures(0.95);
  EXPECT_NEAR(Find(figures, "bias_z_mm")->value, 14.5, 1e-9);
  EXPECT_EQ(Find(figures, "bias_z_mm")->of, 10);
  EXPECT_LT(Find(figures, "bias_z_mm")->interval->lower, 14.5);
  EXPECT_FALSE(Find(figures, "rmse_across_mm")->interval.has_value());  // All are equal: 0.
  EXPECT_LT(Find(figures, "rmse_mm")->interval->lower, Find(figures, "rmse_mm")->value);
  EXPECT_EQ(Find(figures, "p50_error_mm")->of, 20);
  EXPECT_NEAR(Find(figures, "p50_error_mm")->value, 19.0, 1e-9);
  EXPECT_EQ(Find(figures, "p50_error_mm")->interval->upper,
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(Find(figures, "p95_error_mm")->value, std::numeric_limits<double>::infinity());
}

TEST(FigureTally, WiderConfidenceIsWider) {
  FigureTally tally;
  for (int i = 0; i < 40; ++i) tally.Add(Row(Outcome::kHit, {0, 0.001 * (i % 7), 0.001 * i}));
  for (const char* name : {"hit_rate", "bias_z_mm", "rmse_mm", "p50_error_mm"}) {
    const Interval narrow = *Find(tally.Figures(0.90), name)->interval;
    const Interval wide = *Find(tally.Figures(0.99), name)->interval;
    EXPECT_LT(wide.lower, narrow.lower) << name;
    EXPECT_GE(wide.upper, narrow.upper) << name;
  }
}

TEST(FigureTally, SaysNothingOfWhatThereIsNot) {
  EXPECT_TRUE(FigureTally().Figures(0.95).empty());
}

}  // namespace
}  // namespace fenestra
