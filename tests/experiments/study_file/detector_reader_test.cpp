#include "experiments/study_file/detector_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiments/study_file/bad_study.h"

namespace fenestra {
namespace {

std::vector<BadStudy> BadDetectors() {
  return {
      {"unknown", kStudyHead + "detectors: [paper-sterio]\n",
       "3:13: unknown detector 'paper-sterio'. Did you mean 'paper-stereo'?"},
      {"nothing like it", kStudyHead + "detectors: [yolo]\n",
       "3:13: unknown detector 'yolo'. Known: paper-stereo, other-stereo, paper-rgbd."},
      {"none", kStudyHead + "detectors: []\n", "3:12: detectors must be a list of at least one"},
      {"without name", kStudyHead + "detectors: [{label: a}]\n", "a detector needs a name"},
      {"option", kStudyHead + "detectors:\n  - name: paper-stereo\n    options: {windw_px: 7}\n",
       "5:15: unknown key 'windw_px' in options of paper-stereo. Did you mean 'window_px'?"},
      {"option value",
       kStudyHead + "detectors:\n  - name: paper-stereo\n    options: {window_px: 7.5}\n",
       "5:26: window_px must be a whole number from 5 to 31, not '7.5'"},
      {"label twice", kStudyHead + "detectors: [paper-stereo, paper-rgbd, paper-stereo]\n",
       "3:39: two detectors are called 'paper-stereo': give this one a label"},
      {"without its sensor",
       kStudyHead + "sensors: [rgbd]\ndetectors: [paper-rgbd, other-stereo]\n",
       "4:25: other-stereo works on stereo, which part 'main' does not use"},
      {"without its sensor in any part",
       kStudyHead + "detectors: [paper-rgbd, other-stereo]\nparts: [{name: a, sensors: [rgbd]}]\n",
       "3:25: other-stereo works on stereo, which no part uses"},
      {"sensor without", kStudyHead + "detectors: [paper-rgbd]\n",
       "part 'main' has no detector for its sensor stereo"},
  };
}

class DetectorReaderRejects : public BadStudies {};

TEST_P(DetectorReaderRejects, WithPositionAndHint) {
  ExpectFault();
}

INSTANTIATE_TEST_SUITE_P(Detectors, DetectorReaderRejects, ::testing::ValuesIn(BadDetectors()),
                         NameOf);

TEST(DetectorReader, TellsOptionsFromDefaults) {
  const Study study = ReadText(kStudyHead +
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

}  // namespace
}  // namespace fenestra
