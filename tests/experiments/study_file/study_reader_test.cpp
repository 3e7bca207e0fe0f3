#include "experiments/study_file/study_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/experiments/study_file/bad_study.h"

namespace fenestra {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(StudyReader, FillsInAllDefaults) {
  const Study study = ReadText(kStudyHead);
  EXPECT_EQ(study.seed, 1u);
  EXPECT_FALSE(study.independent_cells);
  ASSERT_EQ(study.parts.size(), 1u);
  const StudyPart& part = study.parts.front();
  EXPECT_EQ(part.name, "main");
  EXPECT_EQ(part.repetitions, 2);
  EXPECT_THAT(part.sensors, ElementsAre(SensorKind::kStereo, SensorKind::kRgbd));
  ASSERT_EQ(part.detectors.size(), 3u);
  EXPECT_EQ(part.detectors[0].options.at("window_px"), ParameterValue(15.0));
  EXPECT_EQ(part.detectors[0].options.at("matcher"), ParameterValue(std::string("sad")));
  // All but what only the facade has.
  for (const ParameterInfo& info : Factors().infos()) {
    const bool given = std::any_of(part.factors.begin(), part.factors.end(),
                                   [&info](const Factor& f) { return f.name == info.name; });
    EXPECT_EQ(given, GroupOf(info.name) != FactorGroup::kFacade) << info.name;
  }
}

TEST(StudyReader, PartsOverrideTheStudy) {
  const Study study = ReadText(R"(
name: test
repetitions: 5
detectors: [paper-rgbd, {name: paper-stereo, label: wide, options: {window_px: 31}}]
factors: {distance_m: [2, 3], yaw_deg: {uniform: [-1, 1]}, sky_illuminance_lx: [100, 1000]}
parts:
  - name: near
    sensors: [rgbd]
    factors: {rgbd_near_mode: true, distance_m: 0.6}
  - name: far
    repetitions: 7
    detectors: [other-stereo, paper-rgbd]
)");
  ASSERT_EQ(study.parts.size(), 2u);
  const StudyPart& near = study.parts[0];
  EXPECT_EQ(near.repetitions, 5);
  ASSERT_EQ(near.detectors.size(), 1u);
  EXPECT_EQ(near.detectors[0].name, "paper-rgbd");
  // An overridden factor keeps its place; a new one comes behind.
  EXPECT_EQ(near.factors[0], (Factor{"distance_m", Levels{0.6}}));
  EXPECT_EQ(near.factors[1].name, "yaw_deg");
  EXPECT_EQ(near.factors[3], (Factor{"rgbd_near_mode", Levels{true}}));
  const StudyPart& far = study.parts[1];
  EXPECT_EQ(far.repetitions, 7);
  ASSERT_EQ(far.detectors.size(), 2u);
  EXPECT_EQ(far.detectors[0].name, "other-stereo");
}

// The corners of what is drawn are tried, not the far ends of a normal distribution.
TEST(StudyReader, AcceptsWhatIsNeverDrawn) {
  EXPECT_THAT(FaultsOf(kStudyHead + "factors:\n  window_width_m: {normal: {mean: 1, sd: 0.01}}\n"),
              IsEmpty());
}

std::vector<BadStudy> BadStructures() {
  return {
      {"a list", "[1, 2]", "1:1: the study must be a mapping"},
      {"no name", "repetitions: 2\n", "1:1: the study needs a name"},
      {"name of a path", "name: ../x\nrepetitions: 2\n", "1:7: name must be 1 to 64 of"},
      {"unknown key", kStudyHead + "sede: 2\n",
       "3:1: unknown key 'sede' in the study. Did you mean "
       "'seed'?"},
      {"negative seed", kStudyHead + "seed: -1\n",
       "3:7: seed must be a whole number from 0 to "
       "9223372036854775807"},
      {"seed too large", kStudyHead + "seed: 9223372036854775808\n", "3:7: seed must be"},
      {"no repetitions", "name: test\n", "1:1: part 'main' needs repetitions"},
      {"repetitions 0", "name: test\nrepetitions: 0\n",
       "2:14: repetitions must be a whole number "
       "from 1 to 1000000"},
      {"unknown sensor", kStudyHead + "sensors: [lidar]\n",
       "3:11: unknown sensor 'lidar'. Known: "
       "stereo, rgbd."},
      {"sensor twice", kStudyHead + "sensors: [rgbd, rgbd]\n",
       "3:17: the sensor 'rgbd' stands twice"},
      {"no sensors", kStudyHead + "sensors: []\n", "3:10: sensors must be a list"},
      {"no parts", kStudyHead + "parts: []\n", "3:8: parts must be a list of at least one part"},
      {"part without name", kStudyHead + "parts:\n  - {repetitions: 3}\n",
       "4:5: a part needs a name"},
      {"parts of one name", kStudyHead + "parts:\n  - name: a\n  - name: b\n  - name: a\n",
       "6:11: two parts are called 'a'"},
      {"unknown key in a part", kStudyHead + "parts:\n  - name: a\n    factor: {distance_m: 2}\n",
       "5:5: unknown key 'factor' in a part. Did you mean 'factors'?"},
  };
}

class StudyReaderRejects : public BadStudies {};

TEST_P(StudyReaderRejects, WithPositionAndHint) {
  ExpectFault();
}

INSTANTIATE_TEST_SUITE_P(Structures, StudyReaderRejects, ::testing::ValuesIn(BadStructures()),
                         NameOf);

TEST(StudyReader, ReportsAllFaultsInTheOrderOfTheFile) {
  EXPECT_THAT(FaultsOf("name: test\nrepetitions: many\nseed: 1.5\nfactors:\n  distance_m: [2, x]\n"
                       "  yaw_deg: {uniform: [1]}\n"),
              ElementsAre(HasSubstr("2:14: repetitions"), HasSubstr("3:7: seed"),
                          HasSubstr("5:19: distance_m"), HasSubstr("6:22: uniform of yaw_deg")));
}

}  // namespace
}  // namespace fenestra
