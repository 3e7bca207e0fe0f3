#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/study_file/study_writer.h"
#include "tests/experiments/study_file/study_text.h"

// Studies that stop by themselves or look for an envelope.
namespace fenestra {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string StudyWithRule(const std::string& lines, const std::string& repetitions = "100") {
  return "name: test\nsensors: [stereo]\nrepetitions: " + repetitions + "\n" + lines +
         "\nfactors:\n  distance_m: {from: 1, to: 5, step: 1}\n  azimuth_deg: [10, 0]\n"
         "  rgbd_near_mode: true\nparts: [{name: one, sensors: [stereo, rgbd]}]\n";
}

std::string Envelope(const std::string& over, const std::string& require = "{hit_rate: 0.9}") {
  return "envelope: {over: " + over + ", require: " + require + "}";
}

TEST(StudyRules, AreReadWithTheirDefaults) {
  const Study stopping = ReadText(StudyWithRule("until: {hit_rate: 0.1, bias_mm: 2}"));
  ASSERT_TRUE(stopping.parts[0].until.has_value());
  EXPECT_EQ(stopping.parts[0].until->first_look, 20);
  EXPECT_EQ(stopping.parts[0].until->targets,
            (std::vector<StoppingRule::Target>{{"hit_rate", 0.1}, {"bias_mm", 2.0}}));
  const Study searching = ReadText(StudyWithRule(Envelope("distance_m")));
  EXPECT_EQ(searching.parts[0].envelope->confidence, 0.95);
}

TEST(StudyRules, WhatIsWrittenIsRead) {
  for (const std::string& lines :
       {std::string("until: {p95_error_mm: 12.5, rmse_mm: 1, first_look: 7}"),
        Envelope("distance_m", "{hit_rate: 0.8, p50_error_mm: 10, p95_error_mm: 50.5}")}) {
    const Study study = ReadText(StudyWithRule(lines));
    EXPECT_EQ(ReadText(ToYaml(study)), study);
  }
}

TEST(StudyRules, RefuseWhatCannotWork) {
  const std::vector<std::pair<std::string, std::string>> bad{
      {StudyWithRule("until: {hitrate: 0.1}"),
       "unknown key 'hitrate' in until. Did you mean 'hit_rate'?"},
      {StudyWithRule("until: {first_look: 10}"),
       "until needs the width of at least one of hit_rate"},
      {StudyWithRule("until: {hit_rate: 0}"), "hit_rate must be the width of an interval"},
      {StudyWithRule("until: {hit_rate: 0.1, first_look: 0}"), "first_look must be"},
      {StudyWithRule(Envelope("distance")),
       "unknown factor 'distance'. Did you mean 'distance_m'?"},
      {StudyWithRule(Envelope("distance_m", "{}")), "require needs at least one of hit_rate"},
      {StudyWithRule(Envelope("distance_m", "{hit_rate: 1}")), "hit_rate must be a share"},
      {StudyWithRule("envelope: {over: distance_m}"), "an envelope must be {over: FACTOR"},
      {StudyWithRule("envelope: {over: distance_m, require: {hit_rate: 0.9}, confidence: 95}"),
       "confidence must be a number greater than 0.5 and less than 1, not 95"},
      {StudyWithRule(Envelope("azimuth_deg")),
       "needs at least 3 rising numbers as levels of azimuth_deg"},
      {StudyWithRule(Envelope("yaw_deg")), "needs at least 3 rising numbers as levels of yaw_deg"},
      {StudyWithRule(Envelope("distance_m", "{hit_rate: 0.95}"), "58"),
       "58 repetitions cannot show the requirement with 95 % confidence even if all are good; "
       "about 59 can"},
      {StudyWithRule("until: {hit_rate: 0.1}\n" + Envelope("distance_m")),
       "until and envelope exclude each other"},
      {StudyWithRule("until: {hit_rate: 0.1}\ndesign: sensitivity"),
       "a sensitivity design has no use for until"},
  };
  for (const auto& [text, fault] : bad) {
    EXPECT_THAT(FaultsOf(text), ElementsAre(HasSubstr(fault))) << text;
  }
}

}  // namespace
}  // namespace fenestra
