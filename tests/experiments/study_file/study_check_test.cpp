#include "experiments/study_file/study_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiments/study_file/bad_study.h"

namespace fenestra {
namespace {

std::vector<BadStudy> BadWholes() {
  return {
      {"no effect on the sensor",
       kStudyHead + "sensors: [stereo]\nfactors:\n  rgbd_near_mode: true\n",
       "5:3: rgbd_near_mode has no effect: part 'main' uses another sensor"},
      {"no effect in the scene", WithFactor("glass: true"),
       "4:3: glass has no effect on the painted target; it needs scene: facade"},
      {"no effect in any part",
       kStudyHead + "factors:\n  glass: true\nparts: [{name: a}, {name: b}]\n",
       "4:3: glass has no effect in any part"},
      {"too many cells",
       kStudyHead + "factors:\n  yaw_deg: {from: 0, to: 99, step: 1}\n"
                    "  roll_deg: {from: 0, to: 50, step: 1}\n",
       "the study has 10200 cells; at most 10000 are allowed"},
      {"uncountably many",
       kStudyHead + "sensors: [rgbd]\nfactors:\n" +
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
       kStudyHead + "parts:\n  - name: a\n  - name: b\n    factors:\n      wall_width_m: 0.5\n",
       "7:7: part 'b' contradicts itself: paper_target: a target of 1 m x 1 m does not fit"},
      {"in the facade", WithFactor("scene: facade\n  frame_width_m: 0.7"), "5:3: part 'main'"},
      {"samples", WithFactor("stereo_edge_samples: 100"),
       "4:3: part 'main' contradicts itself: render: edge_samples_per_pixel must be"},
      {"exposures", WithFactor("stereo_shortest_exposure_ms: 50"), "4:3: part 'main'"},
  };
}

class StudyCheckRejects : public BadStudies {};

TEST_P(StudyCheckRejects, WithPositionAndHint) {
  ExpectFault();
}

INSTANTIATE_TEST_SUITE_P(Wholes, StudyCheckRejects, ::testing::ValuesIn(BadWholes()), NameOf);
INSTANTIATE_TEST_SUITE_P(Contradictions, StudyCheckRejects, ::testing::ValuesIn(Contradictions()),
                         NameOf);

}  // namespace
}  // namespace fenestra
