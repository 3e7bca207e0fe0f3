#include "experiments/study_file/study_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "experiments/study_file/factor_reader.h"
#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kHead = "name: test\nrepetitions: 2\n";

std::variant<Levels, Distribution> SettingOf(const Study& study, const std::string& factor) {
  for (const Factor& f : study.parts.front().factors) {
    if (f.name == factor) return f.setting;
  }
  throw std::logic_error("no factor " + factor);
}

std::variant<Levels, Distribution> ReadFactor(const std::string& name, const std::string& text) {
  return SettingOf(ReadText(kHead + "factors:\n  " + name + ": " + text + "\n"), name);
}

TEST(StudyReader, FillsInAllDefaults) {
  const Study study = ReadText(kHead);
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

TEST(StudyReader, ReadsEveryFormOfAFactor) {
  EXPECT_EQ(ReadFactor("distance_m", "3"), (std::variant<Levels, Distribution>(Levels{3.0})));
  EXPECT_EQ(std::get<Levels>(ReadFactor("distance_m", "[1.4, 2, 3]")), (Levels{1.4, 2.0, 3.0}));
  EXPECT_EQ(std::get<Levels>(ReadFactor("target", "[true, false]")), (Levels{true, false}));
  EXPECT_EQ(std::get<Levels>(ReadFactor("azimuth_deg", "{from: 0, to: 40, step: 10}")),
            (Levels{0.0, 10.0, 20.0, 30.0, 40.0}));
  EXPECT_EQ(std::get<Levels>(ReadFactor("azimuth_deg", "{from: -1, to: 1, count: 5}")),
            (Levels{-1.0, -0.5, 0.0, 0.5, 1.0}));
  const auto drawn = [](const std::string& text) {
    return std::get<Distribution>(ReadFactor("yaw_deg", text));
  };
  EXPECT_EQ(drawn("{uniform: [-3, 3]}"), Distribution(UniformDistribution{-3.0, 3.0}));
  EXPECT_EQ(drawn("{log_uniform: [1, 3]}"), Distribution(LogUniformDistribution{1.0, 3.0}));
  EXPECT_EQ(drawn("{triangular: {min: -1, mode: 0, max: 2}}"),
            Distribution(TriangularDistribution{-1.0, 0.0, 2.0}));
  EXPECT_EQ(drawn("{normal: {mean: 1, sd: 2, min: -1, max: 4}}"),
            Distribution(TruncatedNormalDistribution{1.0, 2.0, -1.0, 4.0}));
}

// What a normal distribution leaves open ends with the factor's range.
TEST(StudyReader, AnOpenNormalEndsWithTheRange) {
  EXPECT_EQ(std::get<Distribution>(ReadFactor("yaw_deg", "{normal: {mean: 1, sd: 2}}")),
            Distribution(TruncatedNormalDistribution{1.0, 2.0, -180.0, 180.0}));
  EXPECT_EQ(
      std::get<Distribution>(ReadFactor("distance_m", "{normal: {mean: 1, sd: 1, min: 0.5}}")),
      Distribution(TruncatedNormalDistribution{1.0, 1.0, 0.5, 100.0}));
}

// A tenth of a tenth has no exact double; people still write it as 0.01.
TEST(StudyReader, RangesReadAsPeopleWriteThem) {
  EXPECT_EQ(std::get<Levels>(ReadFactor("roll_deg", "{from: -0.3, to: 0.3, step: 0.1}")),
            (Levels{-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(RoundTo12Digits(0.1 + 0.2), 0.3);
  EXPECT_EQ(RoundTo12Digits(-1.23456789012345e-7), -1.23456789012e-7);
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

TEST(StudyReader, TellsOptionsFromDefaults) {
  const Study study = ReadText(kHead +
                               "detectors:\n  - {name: paper-stereo, label: census-31, options: "
                               "{window_px: 31, matcher: census}}\n  - paper-stereo\n"
                               "sensors: [stereo]\n");
  const std::vector<DetectorChoice>& detectors = study.parts.front().detectors;
  ASSERT_EQ(detectors.size(), 2u);
  EXPECT_EQ(detectors[0].label, "census-31");
  EXPECT_EQ(detectors[0].options.at("window_px"), ParameterValue(31.0));
  EXPECT_EQ(detectors[0].options.at("matcher"), ParameterValue(std::string("census")));
  EXPECT_EQ(detectors[1].label, "paper-stereo");
  EXPECT_EQ(detectors[1].options.at("window_px"), ParameterValue(15.0));
}

// The corners of what is drawn are tried, not the far ends of a normal distribution.
TEST(StudyReader, AcceptsWhatIsNeverDrawn) {
  EXPECT_THAT(FaultsOf(kHead + "factors:\n  window_width_m: {normal: {mean: 1, sd: 0.01}}\n"),
              IsEmpty());
}

}  // namespace
}  // namespace fenestra
