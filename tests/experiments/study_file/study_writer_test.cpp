#include "experiments/study_file/study_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/study_file/study_catalogue.h"
#include "tests/experiments/study_file/study_text.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

const char* const kEverything = R"(
name: every-thing_1
description: "Quotes \" and \\, a colon: a # and\nanother line; façade"
seed: 9223372036854775807
independent_cells: true
repetitions: 3
detectors:
  - {name: paper-stereo, label: wide, options: {window_px: 31, matcher: census}}
  - other-stereo
  - {name: paper-rgbd, options: {ratio: 0.30000000000000004, prior: true}}
factors:
  scene: [facade, paper_target]
  glass: [true, false]
  distance_m: [0.1, 1.0000000000000002, 33.333333333333336, 1e2]
  sun_azimuth_deg: {from: -90, to: 90, step: 22.5}
  yaw_deg: {uniform: [-3.3000000000000003, 0.1]}
  sky_illuminance_lx: {log_uniform: [1e-3, 1e5]}
  roll_deg: {triangular: {min: -1, mode: 0.7, max: 1}}
  pitch_deg: {normal: {mean: 0.1, sd: 1.5}}
parts:
  - name: both
  - name: stereo
    sensors: [stereo]
    factors: {stereo_noise: false, stereo_width_px: [640, 752], distance_m: 2}
)";

TEST(StudyWriter, WhatIsWrittenIsRead) {
  const Study study = ReadText(kEverything);
  EXPECT_EQ(ReadText(ToYaml(study)), study);
  EXPECT_EQ(ToYaml(ReadText(ToYaml(study))), ToYaml(study));
}

TEST(StudyWriter, WritesEveryFactorAndOption) {
  const Study study = ReadText(kEverything);
  const std::string text = ToYaml(study);
  for (const std::string& factor : Factors().Names()) {
    EXPECT_THAT(text, ::testing::HasSubstr("      " + factor + ": ")) << factor;
  }
  EXPECT_THAT(text, ::testing::HasSubstr("matcher: census"));
  EXPECT_THAT(text, ::testing::HasSubstr("glass: [true, false]"));
  EXPECT_THAT(text, ::testing::HasSubstr("pitch_deg: {normal: {mean: 0.1, sd: 1.5, min: -180, "
                                         "max: 180}}"));
}

TEST(StudyCatalogue, EveryBuiltInStudyReadsAndSurvivesWriting) {
  const std::vector<std::string> names = BuiltInStudies();
  EXPECT_THAT(names, testing::IsSupersetOf({"facade", "ideal", "no_window", "paper"}));
  for (const std::string& name : names) {
    const Study study = ReadStudyFile(FindStudy(name), Detectors());
    EXPECT_EQ(study.name, name);
    EXPECT_EQ(ReadStudy(YamlReader::FromText(ToYaml(study), name), Detectors()), study) << name;
  }
}

TEST(StudyCatalogue, APathIsTakenAsItIs) {
  EXPECT_EQ(FindStudy("some/where/paper"), "some/where/paper");
  EXPECT_EQ(FindStudy("mine.yaml"), "mine.yaml");
  EXPECT_THROW(ReadStudyFile("no/such/study.yaml", Detectors()), InputError);
}

TEST(StudyCatalogue, AnUnknownNameIsExplained) {
  try {
    FindStudy("papre");
    FAIL() << "found";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "unknown study 'papre'. Did you mean 'paper'?");
  }
}

}  // namespace
}  // namespace fenestra
