#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "tests/experiments/study_file/study_text.h"

// Every kind of bad study, with the position and the hint that its author gets.
namespace fenestra {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kFaultyHead = "name: test\nrepetitions: 2\n";

struct BadStudy {
  const char* what;
  std::string text;
  std::string fault;  // Line, column and the part of the message that helps.

  friend std::ostream& operator<<(std::ostream& out, const BadStudy& study) {
    return out << study.what;
  }
};

std::string WithFactor(const std::string& line) {
  return kFaultyHead + "factors:\n  " + line + "\n";
}

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

std::vector<BadStudy> BadStructures() {
  return {
      {"a list", "[1, 2]", "1:1: the study must be a mapping"},
      {"no name", "repetitions: 2\n", "1:1: the study needs a name"},
      {"name of a path", "name: ../x\nrepetitions: 2\n", "1:7: name must be 1 to 64 of"},
      {"unknown key", kFaultyHead + "sede: 2\n",
       "3:1: unknown key 'sede' in the study. Did you mean "
       "'seed'?"},
      {"negative seed", kFaultyHead + "seed: -1\n",
       "3:7: seed must be a whole number from 0 to "
       "9223372036854775807"},
      {"seed too large", kFaultyHead + "seed: 9223372036854775808\n", "3:7: seed must be"},
      {"no repetitions", "name: test\n", "1:1: part 'main' needs repetitions"},
      {"repetitions 0", "name: test\nrepetitions: 0\n",
       "2:14: repetitions must be a whole number "
       "from 1 to 1000000"},
      {"unknown sensor", kFaultyHead + "sensors: [lidar]\n",
       "3:11: unknown sensor 'lidar'. Known: "
       "stereo, rgbd."},
      {"sensor twice", kFaultyHead + "sensors: [rgbd, rgbd]\n",
       "3:17: the sensor 'rgbd' stands twice"},
      {"no sensors", kFaultyHead + "sensors: []\n", "3:10: sensors must be a list"},
      {"no parts", kFaultyHead + "parts: []\n", "3:8: parts must be a list of at least one part"},
      {"part without name", kFaultyHead + "parts:\n  - {repetitions: 3}\n",
       "4:5: a part needs a name"},
      {"parts of one name", kFaultyHead + "parts:\n  - name: a\n  - name: b\n  - name: a\n",
       "6:11: two parts are called 'a'"},
      {"unknown key in a part", kFaultyHead + "parts:\n  - name: a\n    factor: {distance_m: 2}\n",
       "5:5: unknown key 'factor' in a part. Did you mean 'factors'?"},
  };
}

std::vector<BadStudy> BadDetectors() {
  return {
      {"unknown", kFaultyHead + "detectors: [paper-sterio]\n",
       "3:13: unknown detector 'paper-sterio'. Did you mean 'paper-stereo'?"},
      {"nothing like it", kFaultyHead + "detectors: [yolo]\n",
       "3:13: unknown detector 'yolo'. Known: paper-stereo, other-stereo, paper-rgbd."},
      {"none", kFaultyHead + "detectors: []\n", "3:12: detectors must be a list of at least one"},
      {"without name", kFaultyHead + "detectors: [{label: a}]\n", "a detector needs a name"},
      {"option", kFaultyHead + "detectors:\n  - name: paper-stereo\n    options: {windw_px: 7}\n",
       "5:15: unknown key 'windw_px' in options of paper-stereo. Did you mean 'window_px'?"},
      {"option value",
       kFaultyHead + "detectors:\n  - name: paper-stereo\n    options: {window_px: 7.5}\n",
       "5:26: window_px must be a whole number from 5 to 31, not '7.5'"},
      {"label twice", kFaultyHead + "detectors: [paper-stereo, paper-rgbd, paper-stereo]\n",
       "3:39: two detectors are called 'paper-stereo': give this one a label"},
      {"without its sensor",
       kFaultyHead + "sensors: [rgbd]\ndetectors: [paper-rgbd, other-stereo]\n",
       "4:25: other-stereo works on stereo, which part 'main' does not use"},
      {"without its sensor in any part",
       kFaultyHead + "detectors: [paper-rgbd, other-stereo]\nparts: [{name: a, sensors: [rgbd]}]\n",
       "3:25: other-stereo works on stereo, which no part uses"},
      {"sensor without", kFaultyHead + "detectors: [paper-rgbd]\n",
       "part 'main' has no detector for its sensor stereo"},
  };
}

std::vector<BadStudy> BadWholes() {
  return {
      {"no effect on the sensor",
       kFaultyHead + "sensors: [stereo]\nfactors:\n  rgbd_near_mode: true\n",
       "5:3: rgbd_near_mode has no effect: part 'main' uses another sensor"},
      {"no effect in the scene", WithFactor("glass: true"),
       "4:3: glass has no effect on the painted target; it needs scene: facade"},
      {"no effect in any part",
       kFaultyHead + "factors:\n  glass: true\nparts: [{name: a}, {name: b}]\n",
       "4:3: glass has no effect in any part"},
      {"too many cells",
       kFaultyHead + "factors:\n  yaw_deg: {from: 0, to: 99, step: 1}\n"
                     "  roll_deg: {from: 0, to: 50, step: 1}\n",
       "the study has 10200 cells; at most 10000 are allowed"},
      {"uncountably many",
       kFaultyHead + "sensors: [rgbd]\nfactors:\n" +
           [] {
             std::string lines;
             for (const char* name : {"yaw_deg", "roll_deg", "pitch_deg", "azimuth_deg",
                                      "elevation_deg", "sun_elevation_deg"}) {
               lines += fmt::format("  {}: {{from: 0, to: 1, count: 10000}}\n", name);
             }
             return lines;
           }(),
       "the study has 1000000000000000000 cells"},
      {"too many trials",
       "name: test\nrepetitions: 300000\nsensors: [rgbd]\nfactors: {yaw_deg: [1, 2, 3, 4]}\n",
       "2:14: the study has 1200000 trials; at most 1000000 are allowed"},
  };
}

std::vector<BadStudy> Contradictions() {
  return {
      {"border wider than the square", WithFactor("frame_width_m: 0.6"),
       "4:3: part 'main' contradicts itself: paper_target: two borders of 0.6 m do not fit"},
      {"one level of it", WithFactor("frame_width_m: [0.1, 0.2, 0.6]"),
       "4:3: part 'main' "
       "contradicts itself"},
      {"in some draws", WithFactor("window_width_m: {uniform: [0.1, 2]}"),
       "4:3: part 'main' contradicts itself"},
      {"in some draws of two",
       WithFactor("window_width_m: {uniform: [0.5, 1]}\n  frame_width_m: {uniform: [0.1, 0.3]}"),
       "part 'main' contradicts itself"},
      {"window larger than the wall",
       kFaultyHead + "parts:\n  - name: a\n  - name: b\n    factors:\n      wall_width_m: 0.5\n",
       "7:7: part 'b' contradicts itself: paper_target: a target of 1 m x 1 m does not fit"},
      {"in the facade", WithFactor("scene: facade\n  frame_width_m: 0.7"), "5:3: part 'main'"},
      {"samples", WithFactor("stereo_edge_samples: 100"),
       "4:3: part 'main' contradicts itself: render: edge_samples_per_pixel must be"},
      {"exposures", WithFactor("stereo_shortest_exposure_ms: 50"), "4:3: part 'main'"},
  };
}

std::string NameOf(const testing::TestParamInfo<BadStudy>& info) {
  std::string name = info.param.what;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

class StudyReaderRejects : public testing::TestWithParam<BadStudy> {};

TEST_P(StudyReaderRejects, WithPositionAndHint) {
  EXPECT_THAT(FaultsOf(GetParam().text), ElementsAre(HasSubstr(GetParam().fault)))
      << GetParam().what;
}

INSTANTIATE_TEST_SUITE_P(Factors, StudyReaderRejects, testing::ValuesIn(BadFactors()), NameOf);
INSTANTIATE_TEST_SUITE_P(Distributions, StudyReaderRejects, testing::ValuesIn(BadDistributions()),
                         NameOf);
INSTANTIATE_TEST_SUITE_P(Structures, StudyReaderRejects, testing::ValuesIn(BadStructures()),
                         NameOf);
INSTANTIATE_TEST_SUITE_P(Detectors, StudyReaderRejects, testing::ValuesIn(BadDetectors()), NameOf);
INSTANTIATE_TEST_SUITE_P(Wholes, StudyReaderRejects, testing::ValuesIn(BadWholes()), NameOf);
INSTANTIATE_TEST_SUITE_P(Contradictions, StudyReaderRejects, testing::ValuesIn(Contradictions()),
                         NameOf);

TEST(StudyReader, ReportsAllFaultsInTheOrderOfTheFile) {
  EXPECT_THAT(FaultsOf("name: test\nrepetitions: many\nseed: 1.5\nfactors:\n  distance_m: [2, x]\n"
                       "  yaw_deg: {uniform: [1]}\n"),
              ElementsAre(HasSubstr("2:14: repetitions"), HasSubstr("3:7: seed"),
                          HasSubstr("5:19: distance_m"), HasSubstr("6:22: uniform of yaw_deg")));
}

}  // namespace
}  // namespace fenestra
