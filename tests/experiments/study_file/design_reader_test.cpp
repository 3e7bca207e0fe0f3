#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/study/sampling_design.h"
#include "experiments/study_file/study_writer.h"
#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string StudyWithDesign(const std::string& design) {
  return "name: test\nrepetitions: 20\nsensors: [stereo]\ndesign: " + design + R"(
factors:
  yaw_deg: {uniform: [0, 1]}
  pitch_deg: {uniform: [0, 1]}
  roll_deg: {uniform: [0, 1]}
  distance_m: 2
)";
}

std::string Correlated(const std::string& list) {
  return StudyWithDesign("{correlations: [" + list + "]}");
}

std::string Pair(const std::string& first, const std::string& second, const std::string& rho) {
  return "{between: [" + first + ", " + second + "], spearman: " + rho + "}";
}

TEST(DesignReader, ReadsTheShortAndTheLongForm) {
  EXPECT_EQ(ReadText(StudyWithDesign("monte_carlo")).parts[0].design, SamplingDesign{});
  EXPECT_EQ(ReadText(StudyWithDesign("sobol")), ReadText(StudyWithDesign("{method: sobol}")));
  const Study study = ReadText(Correlated(Pair("yaw_deg", "roll_deg", "-0.25")));
  EXPECT_EQ(study.parts[0].design, (SamplingDesign{.method = DesignMethod::kMonteCarlo,
                                                   .correlations = {{"yaw_deg", "roll_deg", -0.25}},
                                                   .causes = {}}));
}

TEST(DesignReader, WhatIsWrittenIsRead) {
  for (const std::string& text :
       {StudyWithDesign("latin_hypercube"), StudyWithDesign("sensitivity"),
        StudyWithDesign(
            "{method: sensitivity, causes: {all: [shot, rig, calibration, yaw_deg], tilt: "
            "[pitch_deg, roll_deg]}}"),
        StudyWithDesign("{method: sobol, correlations: [" + Pair("yaw_deg", "roll_deg", "0.1") +
                        "]}")}) {
    EXPECT_EQ(ReadText(ToYaml(ReadText(text))), ReadText(text)) << text;
  }
}

TEST(DesignReader, APartTakesWhatConcernsIt) {
  const Study study = ReadText(Correlated(Pair("yaw_deg", "roll_deg", "0.5")) +
                               "parts:\n  - name: one\n  - name: two\n    factors: {roll_deg: 0}\n"
                               "  - name: three\n    design: sobol\n");
  EXPECT_EQ(study.parts[0].design.correlations.size(), 1u);
  EXPECT_TRUE(study.parts[1].design.correlations.empty());
  EXPECT_EQ(study.parts[2].design.method, DesignMethod::kSobol);
  EXPECT_TRUE(study.parts[2].design.correlations.empty());
}

struct BadDesign {
  std::string text;
  std::string fault;
};

TEST(DesignReader, RefusesWhatCannotBe) {
  const std::vector<BadDesign> bad{
      {StudyWithDesign("sobel"), "4:9: unknown design 'sobel'. Did you mean 'sobol'?"},
      {StudyWithDesign("{methd: sobol}"),
       "unknown key 'methd' in a design. Did you mean 'method'?"},
      {StudyWithDesign("[sobol]"), "4:9: a design must be a mapping (key: value), not a list"},
      {Correlated("0.5"), "a correlation must be a mapping"},
      {Correlated("{between: [yaw_deg], spearman: 0.5}"),
       "a correlation must be {between: [FACTOR"},
      {Correlated(Pair("yaw", "roll_deg", "0.5")), "unknown factor 'yaw'. Did you mean 'yaw_deg'?"},
      {Correlated(Pair("yaw_deg", "yaw_deg", "0.5")), "yaw_deg cannot be correlated with itself"},
      {Correlated(Pair("yaw_deg", "roll_deg", "1")),
       "spearman must be a number from -0.999 to 0.999, not 1"},
      {Correlated(Pair("yaw_deg", "roll_deg", ".nan")), "spearman must be"},
      {Correlated(Pair("yaw_deg", "roll_deg", "0.5") + ", " + Pair("roll_deg", "yaw_deg", "0.4")),
       "roll_deg and yaw_deg are correlated twice"},
      {Correlated(Pair("yaw_deg", "distance_m", "0.5")),
       "distance_m cannot be correlated: part 'main' does not draw it from a distribution"},
      {Correlated(Pair("yaw_deg", "roll_deg", "0.9") + ", " + Pair("yaw_deg", "pitch_deg", "0.9") +
                  ", " + Pair("roll_deg", "pitch_deg", "-0.5")),
       "no joint distribution has the correlations of part 'main'"},
      {StudyWithDesign("{method: sensitivity, correlations: [" +
                       Pair("yaw_deg", "roll_deg", "0.5") + "]}"),
       "a sensitivity design cannot have correlations"},
      {StudyWithDesign("{method: sobol, causes: {noise: [shot]}}"),
       "causes belong to method: sensitivity"},
      {StudyWithDesign("{method: sensitivity, causes: {noise: [shot], pose: [yaw_deg]}}"),
       "these belong to no cause: calibration, pitch_deg, rig, roll_deg"},
      {StudyWithDesign("{method: sensitivity, causes: {noise: [shot, shot]}}"),
       "'shot' belongs to two causes"},
      {StudyWithDesign("{method: sensitivity, causes: {noise: []}}"),
       "cause 'noise' must be a list of"},
      {StudyWithDesign("{method: sensitivity, causes: {noise: [schot]}}"),
       "unknown factor 'schot'"},
      {StudyWithDesign(
           "{method: sensitivity, causes: {all: [shot, rig, calibration, yaw_deg, pitch_deg, "
           "roll_deg, distance_m]}}"),
       "'distance_m' of cause 'all' does not vary in part 'main'"},
  };
  for (const auto& [text, fault] : bad) {
    EXPECT_THAT(FaultsOf(text), ElementsAre(HasSubstr(fault))) << text;
  }
}

TEST(DesignReader, ACorrelationOfTheStudyMustConcernSomePart) {
  EXPECT_THAT(FaultsOf(Correlated(Pair("yaw_deg", "distance_m", "0.5")) +
                       "parts:\n  - name: one\n  - name: two\n"),
              ElementsAre(HasSubstr("no part draws both yaw_deg and distance_m")));
}

}  // namespace
}  // namespace fenestra
