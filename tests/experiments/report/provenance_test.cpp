#include "experiments/report/provenance.h"

#include <gtest/gtest.h>

#include "core/detection/window_prior.h"
#include "experiments/study_file/detector_reader.h"

namespace fenestra {
namespace {

TEST(PriorTextTest, SaysWhatEveryDetectorWasToldAndNothingElse) {
  for (const DetectorInfo& info : Detectors()) {
    DetectorChoice choice = DefaultChoice(info);
    EXPECT_EQ(PriorText(choice), "") << info.name;
    if (!choice.options.contains("expected_width_m")) continue;
    choice.options["expected_width_m"] = 1.2;
    choice.options["expected_height_m"] = 1.0;
    for (auto& [name, value] : choice.options) {
      if (name == "min_side_m") value = 0.5;  // No prior.
    }
    EXPECT_EQ(PriorText(choice), "expected_height_m 1, expected_width_m 1.2") << info.name;
  }
}

TEST(PriorTextTest, AStudyNamesDetectorAndPart) {
  const DetectorInfo* info = FindDetector("edge-stereo");
  ASSERT_NE(info, nullptr);
  Study study{};
  study.parts.push_back({.name = "street",
                         .sensors = {SensorKind::kStereo},
                         .detectors = {DefaultChoice(*info)},
                         .factors = {},
                         .repetitions = 1,
                         .design = {}});
  using Entry = std::pair<std::string, std::string>;
  EXPECT_EQ(PriorEntries(study), std::vector<Entry>({{"Prior", "none"}}));
  study.parts[0].detectors[0].options["expected_shape"] = std::string("rectangle");
  EXPECT_EQ(PriorEntries(study),
            std::vector<Entry>({{"Prior of edge-stereo in street", "expected_shape rectangle"}}));
}

}  // namespace
}  // namespace fenestra
