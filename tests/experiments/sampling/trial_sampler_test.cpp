#include "experiments/sampling/trial_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

const char* const kGrid = R"(
name: grid
seed: 5
repetitions: 3
factors:
  distance_m: [2, 3]
  stereo_baseline_m: [0.2, 0.3, 0.4]
  yaw_deg: {uniform: [-3, 3]}
  azimuth_deg: [0, 10]
  sky_illuminance_lx: 700
  rgbd_near_mode: true
parts:
  - name: one
  - name: two
    sensors: [rgbd]
    repetitions: 4
    factors: {distance_m: 1, yaw_deg: {normal: {mean: 0, sd: 1}}}
)";

double Number(const ParameterValue& value) {
  return std::get<double>(value);
}

TEST(TrialSampler, ATrialIsAFunctionOfItsIndex) {
  const Study study = ReadText(kGrid);
  const Cell cell = Cells(study).front();
  const Trial once = SampleTrial(study, cell, 2);
  const Trial again = SampleTrial(study, cell, 2);
  EXPECT_EQ(once.drawn, again.drawn);
  EXPECT_EQ(once.streams.shot.key(), again.streams.shot.key());
  ASSERT_EQ(once.drawn.size(), 1u);
  // Degrees go through radians and back: one rounding.
  EXPECT_DOUBLE_EQ(Number(Factors().Get(once.settings, "yaw_deg")), Number(once.drawn[0].second));
  EXPECT_EQ(once.settings.viewpoint.distance_m, 2.0);
}

// Two cells draw the same factor at the same rank, even from different distributions.
TEST(TrialSampler, CellsShareTheirRandomNumbers) {
  const Study study = ReadText(kGrid);
  const std::vector<Cell> cells = Cells(study);
  for (int trial = 0; trial < 100; ++trial) {
    const Trial first = SampleTrial(study, cells.front(), trial);
    EXPECT_EQ(first.streams.shot.key(), SampleTrial(study, cells.back(), trial).streams.shot.key());
    EXPECT_EQ(first.drawn, SampleTrial(study, cells[7], trial).drawn);
    const double rank = (Number(first.drawn[0].second) + 3.0) / 6.0;
    const double yaw = Number(SampleTrial(study, cells.back(), trial).drawn[0].second);
    // Ranks of 1e-16 pass through a difference of numbers of size 3 and Φ.
    EXPECT_NEAR(0.5 * std::erfc(-yaw / std::sqrt(2.0)), rank, 1e-14);
  }
}

TEST(TrialSampler, TrialsDiffer) {
  const Study study = ReadText(kGrid);
  const Cell cell = Cells(study).front();
  std::set<double> yaws;
  std::set<uint64_t> keys;
  for (int trial = 0; trial < 1000; ++trial) {
    const Trial sample = SampleTrial(study, cell, trial);
    yaws.insert(Number(sample.drawn[0].second));
    keys.insert(sample.streams.shot.key());
  }
  EXPECT_EQ(yaws.size(), 1000u);
  EXPECT_EQ(keys.size(), 1000u);
}

TEST(TrialSampler, FactorsAreDrawnIndependently) {
  const Study study = ReadText(
      "name: test\nrepetitions: 1\nsensors: [rgbd]\n"
      "factors: {yaw_deg: {uniform: [-1, 1]}, roll_deg: {uniform: [-1, 1]}}\n");
  const Cell cell = Cells(study).front();
  constexpr int kTrials = 2000;
  double covariance = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const FactorValues drawn = SampleTrial(study, cell, trial).drawn;
    covariance += Number(drawn[0].second) * Number(drawn[1].second) / kTrials;
  }
  // A product has mean 0 and variance 1/9; six standard errors: false alarm 2e-9.
  EXPECT_LT(std::abs(covariance), 6.0 / 3.0 / std::sqrt(static_cast<double>(kTrials)));
}

TEST(TrialSampler, IndependentCellsShareNothing) {
  Study study = ReadText(kGrid);
  study.independent_cells = true;
  const std::vector<Cell> cells = Cells(study);
  std::set<uint64_t> keys;
  for (const Cell& cell : cells) {
    for (int trial = 0; trial < 50; ++trial) {
      keys.insert(SampleTrial(study, cell, trial).streams.shot.key());
    }
  }
  EXPECT_EQ(keys.size(), 50 * cells.size());
}

TEST(TrialSampler, AnotherSeedIsAnotherStudy) {
  Study study = ReadText(kGrid);
  const Trial one = SampleTrial(study, Cells(study).front(), 0);
  study.seed = 6;
  const Trial other = SampleTrial(study, Cells(study).front(), 0);
  EXPECT_NE(one.drawn, other.drawn);
}

}  // namespace
}  // namespace fenestra
