#include "experiments/study_file/factor_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/experiments/study_file/bad_study.h"

namespace fenestra {
namespace {

std::vector<BadStudy> BadFactors() {
  return {
      {"unknown", WithFactor("distnace_m: 2"),
       "4:3: unknown key 'distnace_m' in factors. Did you "
       "mean 'distance_m'?"},
      {"without unit", WithFactor("azimuth: 2"),
       "4:3: unknown key 'azimuth' in factors. Did you "
       "mean 'azimuth_deg'?"},
      {"twice", WithFactor("distance_m: 2\n  distance_m: 3"), "5:3: 'distance_m' stands twice"},
      {"word", WithFactor("distance_m: far"), "4:15: distance_m must be a finite number"},
      {"nothing", WithFactor("distance_m:"),
       "4:3: distance_m must be a number from 0.1 to 100, "
       "not nothing"},
      {"out of range", WithFactor("distance_m: -2"),
       "4:15: distance_m must be a number from 0.1 to 100, not '-2'"},
      {"level out of range", WithFactor("distance_m: [2, 3, 1000]"), "4:22: distance_m must be"},
      {"no levels", WithFactor("distance_m: []"), "4:15: distance_m has an empty list of levels"},
      {"same level", WithFactor("distance_m: [2, 3, 2.0]"),
       "4:22: distance_m has the level 2 twice"},
      {"bad choice", WithFactor("scene: facede"),
       "4:10: scene must be one of paper_target, "
       "facade, not 'facede'. Did you mean 'facade'?"},
      {"bad switch", WithFactor("target: yes"), "4:11: target must be true or false, not 'yes'"},
      {"fraction", WithFactor("stereo_width_px: 752.5"),
       "4:20: stereo_width_px must be a whole number"},
      {"odd step", WithFactor("azimuth_deg: {from: 0, to: 40, step: 15}"),
       "4:40: azimuth_deg has a step of 15, which does not divide its range of 40; 13.3333 would"},
      {"step 0", WithFactor("azimuth_deg: {from: 0, to: 40, step: 0}"),
       "4:40: azimuth_deg needs a "
       "step greater than 0"},
      {"tiny step", WithFactor("azimuth_deg: {from: 0, to: 40, step: 1e-9}"),
       "4:40: azimuth_deg has more than 10000 levels"},
      {"step and count", WithFactor("azimuth_deg: {from: 0, to: 40, step: 10, count: 5}"),
       "azimuth_deg needs either a step or a count"},
      {"one level", WithFactor("azimuth_deg: {from: 0, to: 40, count: 1}"),
       "4:41: count of azimuth_deg must be a whole number from 2"},
      {"half a range", WithFactor("azimuth_deg: {from: 0, step: 10}"), "azimuth_deg lacks 'to'"},
      {"backwards", WithFactor("azimuth_deg: {from: 40, to: 0, count: 5}"),
       "azimuth_deg has a range from 40 to 0"},
      {"range too far", WithFactor("azimuth_deg: {from: 0, to: 100, step: 50}"),
       "azimuth_deg must be a number from -89 to 89, not '100'"},
      {"range of words", WithFactor("scene: {from: 0, to: 1, count: 2}"), "scene has no range"},
      {"unknown form", WithFactor("yaw_deg: {unifrom: [-1, 1]}"),
       "4:13: unknown key 'unifrom' in yaw_deg. Did you mean 'uniform'?"},
      {"two forms", WithFactor("yaw_deg: {uniform: [-1, 1], from: 2}"),
       "yaw_deg must be either one range or one distribution"},
  };
}

std::vector<BadStudy> BadDistributions() {
  return {
      {"three ends", WithFactor("yaw_deg: {uniform: [-1, 1, 2]}"),
       "4:22: uniform of yaw_deg must be a list of 2 numbers"},
      {"reversed", WithFactor("yaw_deg: {uniform: [1, -1]}"), "4:22: yaw_deg needs [min, max]"},
      {"beyond the range", WithFactor("distance_m: {uniform: [-1, 2]}"),
       "4:25: distance_m must stay from 0.1 to 100, but is drawn from -1 to 2"},
      {"log of 0", WithFactor("yaw_deg: {log_uniform: [0, 1]}"),
       "4:26: yaw_deg needs a min greater "
       "than 0"},
      {"mode outside", WithFactor("yaw_deg: {triangular: {min: 0, mode: 3, max: 2}}"),
       "yaw_deg needs min ≤ mode ≤ max"},
      {"no mode", WithFactor("yaw_deg: {triangular: {min: 0, max: 2}}"), "yaw_deg lacks 'mode'"},
      {"sd 0", WithFactor("yaw_deg: {normal: {mean: 0, sd: 0}}"),
       "4:35: yaw_deg needs an sd "
       "greater than 0"},
      {"no mean", WithFactor("yaw_deg: {normal: {sd: 1}}"), "yaw_deg lacks 'mean'"},
      // P(X < 0.1) for a mean of 2 and an sd of 1 is Φ(−1.9) = 2.9 %.
      {"open normal", WithFactor("distance_m: {normal: {mean: 2, sd: 1}}"),
       "distance_m must stay from 0.1 to 100, but 2.9 % of this normal distribution lies beyond: "
       "give min and max"},
      {"normal beyond the range", WithFactor("distance_m: {normal: {mean: 2, sd: 1, min: 0}}"),
       "distance_m must stay from 0.1 to 100, but is drawn from 0 to 100"},
      {"normal cut away", WithFactor("yaw_deg: {normal: {mean: 0, sd: 1, min: 8, max: 9}}"),
       "next to nothing of this normal distribution lies"},
      {"drawn word", WithFactor("scene: {uniform: [0, 1]}"), "scene cannot be drawn"},
      {"drawn integer", WithFactor("stereo_width_px: {uniform: [100, 200]}"),
       "stereo_width_px cannot be drawn"},
  };
}

class FactorReaderRejects : public BadStudies {};

TEST_P(FactorReaderRejects, WithPositionAndHint) {
  ExpectFault();
}

INSTANTIATE_TEST_SUITE_P(Factors, FactorReaderRejects, ::testing::ValuesIn(BadFactors()), NameOf);
INSTANTIATE_TEST_SUITE_P(Distributions, FactorReaderRejects,
                         ::testing::ValuesIn(BadDistributions()), NameOf);

std::variant<Levels, Distribution> SettingOf(const Study& study, const std::string& factor) {
  for (const Factor& f : study.parts.front().factors) {
    if (f.name == factor) return f.setting;
  }
  throw std::logic_error("no factor " + factor);
}

std::variant<Levels, Distribution> ReadFactor(const std::string& name, const std::string& text) {
  return SettingOf(ReadText(kStudyHead + "factors:\n  " + name + ": " + text + "\n"), name);
}

TEST(FactorReader, ReadsEveryFormOfAFactor) {
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
TEST(FactorReader, AnOpenNormalEndsWithTheRange) {
  EXPECT_EQ(std::get<Distribution>(ReadFactor("yaw_deg", "{normal: {mean: 1, sd: 2}}")),
            Distribution(TruncatedNormalDistribution{1.0, 2.0, -180.0, 180.0}));
  EXPECT_EQ(
      std::get<Distribution>(ReadFactor("distance_m", "{normal: {mean: 1, sd: 1, min: 0.5}}")),
      Distribution(TruncatedNormalDistribution{1.0, 1.0, 0.5, 100.0}));
}

// A tenth of a tenth has no exact double; people still write it as 0.01.
TEST(FactorReader, RangesReadAsPeopleWriteThem) {
  EXPECT_EQ(std::get<Levels>(ReadFactor("roll_deg", "{from: -0.3, to: 0.3, step: 0.1}")),
            (Levels{-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(RoundTo12Digits(0.1 + 0.2), 0.3);
  EXPECT_EQ(RoundTo12Digits(-1.23456789012345e-7), -1.23456789012e-7);
}

}  // namespace
}  // namespace fenestra
