#include "experiments/analysis/error_budget.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/report/error_budget_report.h"
#include "experiments/sampling/trial_sampler.h"
#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

const char* const kStudy = R"(
name: test
sensors: [stereo]
detectors: [paper-stereo]
repetitions: 7200
design: sensitivity
factors:
  yaw_deg: {uniform: [-1, 1]}
  sky_illuminance_lx: {uniform: [0, 1]}
)";

// A detector whose depth error is the sum of the noise's and the pose's, and whose error to the
// right is that of the light and of the calibration together; it misses where it is too dark.
TrialRecord Record(const Cell& cell, const Trial& trial, double dark) {
  TrialRecord record;
  record.cell = cell.index;
  record.trial = trial.index;
  record.part = cell.part;
  record.detector = "paper-stereo";
  record.score.truth_p_CO = Eigen::Vector3d(0, 0, 3);
  const double yaw = std::get<double>(trial.drawn[0].second);
  const double light = std::get<double>(trial.drawn[1].second);
  if (light < dark) {
    record.score.outcome = Outcome::kMissed;
    return record;
  }
  record.score.outcome = Outcome::kHit;
  WindowEstimate estimate;
  estimate.p_CO = *record.score.truth_p_CO +
                  1e-3 * Eigen::Vector3d((light - 0.5) * trial.streams.rig.Normal(0), 0.0,
                                         5.0 + trial.streams.shot.Normal(0) + std::sqrt(3.0) * yaw);
  record.score.estimate = estimate;
  return record;
}

ErrorBudget BudgetWith(double dark) {
  const Study study = ReadText(kStudy);
  const std::vector<Cell> cells = Cells(study);
  const Cell& cell = cells.front();
  const TrialSampler sampler(study, cell);
  ErrorBudgets budgets(study, cells);
  for (int i = cell.repetitions - 1; i >= 0; --i) {  // The order does not matter.
    budgets.Add(Record(cell, sampler.Sample(i), dark));
  }
  const std::vector<ErrorBudget> all = budgets.Budgets();
  EXPECT_EQ(all.size(), 1u);
  return all.front();
}

TEST(ErrorBudget, SharesOutTheVarianceAmongItsCauses) {
  const ErrorBudget budget = BudgetWith(0.0);
  EXPECT_EQ(budget.causes, (std::vector<std::string>{"noise", "calibration", "pose", "light"}));
  EXPECT_EQ(budget.rows, 1200);
  EXPECT_EQ(budget.used_rows, 1200);
  const CoordinateBudget& depth = budget.coordinates[2];
  // Both parts have variance 1 mm²: a half each. Standard error of a correlation near ½ from 1200
  // rows: 0.75/√1200 = 0.022; five: 6e-7 each.
  EXPECT_NEAR((*depth.indices)[0].first, 0.5, 0.11);
  EXPECT_NEAR((*depth.indices)[2].first, 0.5, 0.11);
  EXPECT_NEAR((*depth.indices)[0].total, 0.5, 0.11);
  for (const size_t none : {1u, 3u}) {
    EXPECT_NEAR((*depth.indices)[none].first, 0.0, 5.0 / std::sqrt(1200.0));
    EXPECT_NEAR((*depth.indices)[none].total, 0.0, 1e-12);  // Exchanging it changes nothing.
  }
  EXPECT_NEAR(depth.mean_m, 5e-3, 5.0 * 1.414e-3 / std::sqrt(2400.0));
  EXPECT_NEAR(depth.standard_deviation_m, 1.414e-3, 0.1e-3);
  // Half widths to first order: 1.96 σ/√n, and 1.96 σ √((κ - 1)/4n) with the kurtosis κ = 2.7 of
  // the sum of a normal and a uniform variable of equal variance.
  const auto half_mm = [](const std::optional<Interval>& interval_m) {
    return 0.5e3 * (interval_m->upper - interval_m->lower);
  };
  EXPECT_NEAR(half_mm(depth.mean_interval_m), 1.96 * 1.414 / std::sqrt(2400.0), 0.003);
  EXPECT_NEAR(half_mm(depth.standard_deviation_interval_m),
              1.96 * 1.414 * std::sqrt(1.7 / (4.0 * 2400.0)), 0.004);
  // A product of two centred causes: nothing alone, all of it in total.
  const CoordinateBudget& right = budget.coordinates[0];
  for (const size_t both : {1u, 3u}) {
    EXPECT_NEAR((*right.indices)[both].first, 0.0, 0.2);
    EXPECT_NEAR((*right.indices)[both].total, 1.0, 0.2);
  }
  EXPECT_FALSE(budget.coordinates[1].indices.has_value());  // Never any error downwards.
}

TEST(ErrorBudget, SaysHowManyTrialsItLeavesOut) {
  const ErrorBudget budget = BudgetWith(0.2);
  EXPECT_EQ(budget.trials, 7200);
  // A fifth is missed: standard deviation of the count at most 34 if trials were independent, and
  // since the light of a row is that of five of its six trials no more than 34 √6 = 83.
  EXPECT_NEAR(budget.hits, 5760, 5 * 83);
  // A row is kept if both of its lights are bright enough: 0.64.
  EXPECT_NEAR(budget.used_rows, 768, 5 * 17);
  const std::string text = ErrorBudgetMarkdown(std::vector{budget});
  EXPECT_THAT(text, ::testing::HasSubstr(fmt::format("{} of 7200 trials are hits", budget.hits)));
  EXPECT_THAT(text, ::testing::HasSubstr("| noise "));
  EXPECT_THAT(ErrorBudgetCsv(std::vector{budget}), ::testing::HasSubstr(",depth,"));
  EXPECT_EQ(ErrorBudgetMarkdown({}), "");
}

}  // namespace
}  // namespace fenestra
