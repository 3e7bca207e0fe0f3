#include "experiments/run/study_explanation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;

Study TwoSensors() {
  return ReadText(
      "name: test\nseed: 7\ndescription: Does it?\nrepetitions: 20\nfactors:\n"
      "  distance_m: [2, 3, 4]\n  stereo_noise: [true, false]\n"
      "  yaw_deg: {uniform: [-1, 1]}\n");
}

std::vector<CellClass> Explained(const Study& study) {
  return ExplainStudy(study, 0, nullptr);
}

TEST(StudyExplanation, CellsOfOnePartAndSensorAreOneClass) {
  const std::vector<CellClass> classes = Explained(TwoSensors());
  ASSERT_EQ(classes.size(), 2u);
  const CellClass& stereo = classes[0];
  EXPECT_EQ(stereo.sensor, SensorKind::kStereo);
  EXPECT_EQ(stereo.cells, 6);
  EXPECT_EQ(stereo.trials, 120);
  EXPECT_THAT(stereo.detectors, ElementsAre("paper-stereo", "other-stereo"));
  EXPECT_FALSE(stereo.cost.has_value());
  // What concerns the other sensor alone does not multiply this one's cells.
  const CellClass& rgbd = classes[1];
  EXPECT_EQ(rgbd.cells, 3);
  EXPECT_EQ(rgbd.trials, 60);
  EXPECT_THAT(rgbd.detectors, ElementsAre("paper-rgbd"));
  EXPECT_THAT(rgbd.varied, ElementsAre(Pair("distance_m", "[2, 3, 4]")));
  EXPECT_THAT(rgbd.drawn, ElementsAre(Pair("yaw_deg", "{uniform: [-1, 1]}")));
}

TEST(StudyExplanation, CountsAreThoseOfTheStudy) {
  const Study study = TwoSensors();
  int64_t cells = 0;
  int64_t trials = 0;
  for (const CellClass& c : Explained(study)) {
    cells += c.cells;
    trials += c.trials;
  }
  EXPECT_EQ(cells, CountCells(study));
  EXPECT_EQ(trials, CountTrials(study));
}

TEST(StudyExplanation, PartsAreExplainedApart) {
  const Study study = ReadText(
      "name: test\nrepetitions: 2\nsensors: [rgbd]\nparts:\n"
      "  - {name: near, factors: {distance_m: [1, 2]}}\n"
      "  - {name: far, repetitions: 5, factors: {distance_m: 9}}\n");
  const std::vector<CellClass> classes = Explained(study);
  ASSERT_EQ(classes.size(), 2u);
  EXPECT_EQ(classes[0].part, "near");
  EXPECT_EQ(classes[0].trials, 4);
  EXPECT_EQ(classes[1].part, "far");
  EXPECT_EQ(classes[1].cells, 1);
  EXPECT_EQ(classes[1].trials, 5);
  EXPECT_TRUE(classes[1].varied.empty());
}

TEST(StudyExplanation, TheDesignSaysHowTrialsAreDrawn) {
  const std::string head =
      "name: test\nrepetitions: 20\nsensors: [rgbd]\nfactors:\n"
      "  yaw_deg: {uniform: [-1, 1]}\n  roll_deg: {uniform: [-1, 1]}\n";
  EXPECT_EQ(Explained(ReadText(head)).at(0).design, "monte_carlo");
  EXPECT_THAT(Explained(ReadText(head + "design: {method: latin_hypercube, correlations: "
                                        "[{between: [yaw_deg, roll_deg], spearman: 0.5}]}\n"))
                  .at(0)
                  .design,
              HasSubstr("latin_hypercube; Spearman's ρ of yaw_deg and roll_deg: 0.5"));
  EXPECT_THAT(Explained(ReadText(head + "design: sensitivity\n")).at(0).design,
              HasSubstr("rows of"));
}

TEST(StudyExplanation, TheTextHasWhatIsComparedDrawnAndTheTotals) {
  const Study study = TwoSensors();
  const std::string text = ExplanationText(study, Explained(study), 4);
  EXPECT_THAT(text, HasSubstr("test: Does it?"));
  EXPECT_THAT(text, HasSubstr("stereo, 6 cells of 20 trials = 120 trials"));
  EXPECT_THAT(text, HasSubstr("rgbd, 3 cells of 20 trials = 60 trials"));
  EXPECT_THAT(text, HasSubstr("distance_m: [2, 3, 4]"));
  EXPECT_THAT(text, HasSubstr("yaw_deg: {uniform: [-1, 1]}"));
  // 120 trials of two detectors and 60 of one.
  EXPECT_THAT(text, HasSubstr("In all 9 cells, 180 trials, 300 rows; seed 7;"));
  EXPECT_THAT(text, Not(HasSubstr("job"))) << "what was not measured is not estimated";
}

// 6 cells at 2 s and 120 trials at 0.5 s: 72 s on one job, 18 s on four.
TEST(StudyExplanation, TimesAndSizesAreSharedAmongTheJobs) {
  const Study study = TwoSensors();
  std::vector<CellClass> classes = Explained(study);
  classes.pop_back();
  classes[0].cost =
      TrialCost{.cell_s = 2.0, .trial_s = 0.5, .row_bytes = 1e4, .picture_bytes = 3e5};
  EXPECT_THAT(ExplanationText(study, classes, 1), HasSubstr("About 1 min 12 s with 1 job, and 3"));
  EXPECT_THAT(ExplanationText(study, classes, 4), HasSubstr("About 18.0 s with 4 jobs, and 3"));
  EXPECT_THAT(ExplanationText(study, classes, 4), HasSubstr("3.00 MB on disk"));
}

}  // namespace
}  // namespace fenestra
