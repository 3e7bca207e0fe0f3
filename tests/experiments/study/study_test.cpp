#include "experiments/study/study.h"

#include <gtest/gtest.h>

#include <stdexcept>

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

TEST(Study, CellsAreTheFullGridOfEachSensor) {
  const Study study = ReadText(kGrid);
  const std::vector<Cell> cells = Cells(study);
  // Part one: 2 · 3 · 2 for stereo, 2 · 2 for the sensor without a stereo baseline; part two: 2.
  ASSERT_EQ(cells.size(), 12u + 4u + 2u);
  EXPECT_EQ(CountCells(study), 18);
  EXPECT_EQ(CountTrials(study), 3 * 16 + 4 * 2);
  for (size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(cells[i].index, static_cast<int>(i));
    EXPECT_EQ(cells[i].part, i < 16 ? "one" : "two");
    EXPECT_EQ(cells[i].repetitions, i < 16 ? 3 : 4);
    EXPECT_EQ(cells[i].sensor, i < 12 ? SensorKind::kStereo : SensorKind::kRgbd);
    EXPECT_EQ(cells[i].levels.size(), i < 12 ? 3u : 2u);
  }
}

TEST(Study, TheLastFactorRunsFastest) {
  const std::vector<Cell> cells = Cells(ReadText(kGrid));
  size_t i = 0;
  for (const double distance : {2.0, 3.0}) {
    for (const double baseline : {0.2, 0.3, 0.4}) {
      for (const double azimuth : {0.0, 10.0}) {
        const FactorValues expected{
            {"distance_m", distance}, {"stereo_baseline_m", baseline}, {"azimuth_deg", azimuth}};
        EXPECT_EQ(cells[i].levels, expected) << i;
        EXPECT_EQ(cells[i].settings.viewpoint.distance_m, distance);
        EXPECT_EQ(cells[i].settings.stereo.baseline_m, baseline);
        EXPECT_EQ(cells[i].settings.lighting.sky.illuminance_lx, 700.0);
        ++i;
      }
    }
  }
}

// A factor that varies in one part is shown in the others too.
TEST(Study, PartsAreComparable) {
  const std::vector<Cell> cells = Cells(ReadText(kGrid));
  EXPECT_EQ(cells[16].levels, (FactorValues{{"distance_m", 1.0}, {"azimuth_deg", 0.0}}));
  EXPECT_EQ(cells[17].levels, (FactorValues{{"distance_m", 1.0}, {"azimuth_deg", 10.0}}));
}

TEST(Study, CellsHaveTheirSensorsDetectorsAndDraws) {
  const Study study = ReadText(kGrid);
  const std::vector<Cell> cells = Cells(study);
  EXPECT_EQ(DetectorsOf(study, cells.front()).size(), 2u);
  EXPECT_EQ(DetectorsOf(study, cells.back()).size(), 1u);
  ASSERT_EQ(DrawnFactors(study, cells.front()).size(), 1u);
  EXPECT_EQ(DrawnFactors(study, cells.front()).front().first, "yaw_deg");
}

TEST(Study, RefusesToMakeTooManyCells) {
  Study study = ReadText(kGrid);
  Levels many;
  for (int i = 0; i < 10'000; ++i) many.emplace_back(1.0 + 0.001 * i);
  for (Factor& factor : study.parts[0].factors) {
    if (factor.name == "distance_m") factor.setting = many;
  }
  EXPECT_THROW(Cells(study), std::logic_error);
}

}  // namespace
}  // namespace fenestra
