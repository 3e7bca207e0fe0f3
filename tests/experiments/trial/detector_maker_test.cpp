// Detectors that run outside of this process, in studies.

#include "experiments/trial/detector_maker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>

#include "core/io/input_error.h"
#include "experiments/report/report.h"
#include "experiments/run/run_study.h"
#include "experiments/run/run_trials.h"
#include "experiments/study_file/study_reader.h"
#include "experiments/study_file/study_writer.h"
#include "tests/support/temporary_folder.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

Study StudyWith(const std::string& detectors, int repetitions) {
  const std::string text = "name: separate\nrepetitions: " + std::to_string(repetitions) +
                           "\nsensors: [stereo]\nfactors:\n  distance_m: 1.5\n"
                           "  yaw_deg: {uniform: [-1, 1]}\n  window_width_m: 0.8\n"
                           "  window_height_m: 0.8\ndetectors:\n" +
                           detectors;
  return ReadStudy(YamlReader::FromText(text, "separate.yaml"), Detectors());
}

std::string Fake(const std::string& how) {
  return "  - {name: " + how + ", command: [" FENESTRA_FAKE_DETECTOR ", " + how +
         ", third], sensor: stereo, time_limit_s: 1}\n";
}

std::vector<TrialRecord> Rows(const Study& study, int jobs,
                              const std::shared_ptr<DetectorMaker>& maker) {
  const std::vector<Cell> cells = Cells(study);
  std::vector<TrialRecord> rows;
  std::mutex mutex;
  const RunOptions options{.jobs = jobs, .detectors = maker};
  RunTrials(study, cells, AllTrials(cells), options, [&](const FinishedTrial& trial) {
    const std::lock_guard lock(mutex);
    for (TrialRecord record : trial.Records()) {
      record.stages.clear();
      rows.push_back(record);
    }
  });
  std::sort(rows.begin(), rows.end(), [](const TrialRecord& a, const TrialRecord& b) {
    return std::tie(a.detector, a.cell, a.trial) < std::tie(b.detector, b.cell, b.trial);
  });
  return rows;
}

TEST(DetectorMakerTest, EachFaultCostsItsTrialsAloneWhateverTheNumberOfJobs) {
  // Which trials the fakes spoil, their pixels say: the same for all of them.
  const Study study =
      StudyWith(Fake("crash") + Fake("bad_json") + Fake("behind") + Fake("hang"), 8);
  const std::vector<TrialRecord> rows = Rows(study, 1, std::make_shared<DetectorMaker>());
  ASSERT_EQ(rows.size(), 4u * 8u);
  int spoilt = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const bool crashed = rows[i].score.outcome == Outcome::kCrashed;
    EXPECT_EQ(crashed, rows[i % 8].score.outcome == Outcome::kCrashed) << rows[i].detector;
    EXPECT_EQ(crashed, !rows[i].score.estimate);
    spoilt += crashed ? 1 : 0;
  }
  EXPECT_GT(spoilt, 0);
  EXPECT_LT(spoilt, 4 * 8);
  EXPECT_EQ(TrialsCsv(Rows(study, 2, std::make_shared<DetectorMaker>())), TrialsCsv(rows));
}

TEST(DetectorMakerTest, AnIsolatedDetectorGivesTheBitsOfTheOneInProcess) {
  const Study study = StudyWith(
      "  - edge-stereo\n  - {name: edge-stereo, label: isolated, isolate: true}\n"
      "  - paper-stereo\n  - {name: paper-stereo, label: paper-isolated, isolate: true}\n",
      2);
  const auto maker =
      std::make_shared<DetectorMaker>(std::vector<std::string>{FENESTRA_PROGRAM, "serve"});
  std::map<std::string, std::vector<TrialRecord>> of_label;
  for (TrialRecord row : Rows(study, 1, maker)) {
    ASSERT_TRUE(row.score.estimate)
        << row.detector << ": " << row.score.reason << " " << row.score.detail;
    std::vector<TrialRecord>& rows = of_label[row.detector];
    row.detector = "";
    rows.push_back(row);
  }
  EXPECT_EQ(TrialsCsv(of_label["isolated"]), TrialsCsv(of_label["edge-stereo"]));
  EXPECT_EQ(TrialsCsv(of_label["paper-isolated"]), TrialsCsv(of_label["paper-stereo"]));
  EXPECT_NE(TrialsCsv(of_label["isolated"]), TrialsCsv(of_label["paper-isolated"]));
}

TEST(DetectorMakerTest, AResolvedStudyReadsBackTheSame) {
  const Study study = StudyWith(
      "  - {name: mine, command: [python3, \"my detector.py\"], sensor: stereo, start_limit_s: 3,\n"
      "     options: {size_m: 0.5, fast: true, mode: \"1\"}}\n"
      "  - {name: edge-stereo, isolate: true, time_limit_s: 2.5}\n  - paper-stereo\n",
      1);
  EXPECT_EQ(ReadStudy(YamlReader::FromText(ToYaml(study), "resolved.yaml"), Detectors()), study);
  const DetectorChoice& mine = study.parts[0].detectors[0];
  EXPECT_EQ(mine.process->command, (std::vector<std::string>{"python3", "my detector.py"}));
  EXPECT_EQ(mine.options.at("mode"), ParameterValue("1"));
  EXPECT_EQ(mine.options.at("fast"), ParameterValue(true));
  EXPECT_FALSE(study.parts[0].detectors[2].process);
}

TEST(DetectorMakerTest, AProgramThatDoesNotExistEndsARunBeforeItLeavesAnything) {
  const TemporaryFolder folder;
  const StudyRun run{
      .study = StudyWith("  - {name: mine, command: [/no/such], sensor: stereo}\n", 1),
      .study_text = "",
      .out = folder / "out"};
  EXPECT_THROW(RunStudy(run), InputError);
  EXPECT_TRUE(folder.IsEmpty());
}

class FaultyEntryTest : public ::testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(FaultyEntryTest, IsRefusedWithItsPlace) {
  try {
    StudyWith("  - " + GetParam().first + "\n", 1);
    FAIL() << GetParam().first;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("separate.yaml:10:"));
    EXPECT_THAT(error.what(), HasSubstr(GetParam().second));
  }
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, FaultyEntryTest,
    ::testing::Values(
        std::pair{"{name: a, command: python3, sensor: stereo}", "command must be a list of words"},
        std::pair{"{name: a, command: [], sensor: stereo}", "command must be a list of words"},
        std::pair{"{name: a, command: [x]}", "needs a sensor"},
        std::pair{"{command: [x], sensor: stereo}", "needs a name"},
        std::pair{"{name: a, command: [x], sensor: lidar}", "unknown sensor"},
        std::pair{"{name: edge-stereo, command: [x], sensor: stereo}", "call the one"},
        std::pair{"{name: a, command: [x], sensor: stereo, time_limit_s: 0}", "above 0"},
        std::pair{"{name: a, command: [x], sensor: stereo, options: {b: [1]}}", "b must be"},
        std::pair{"{name: a, command: [x], sensor: stereo, isolate: true}", "unknown key"},
        std::pair{"{name: edge-stereo, time_limit_s: 3}", "no effect without isolate"},
        std::pair{"{name: edge-stereo, isolate: maybe}", "isolate must be true or false"}));

TEST(DetectorMakerTest, ACalibrationThatADetectorRefusesEndsARun) {
  const TemporaryFolder folder;
  const auto maker =
      std::make_shared<DetectorMaker>(std::vector<std::string>{FENESTRA_PROGRAM, "serve"});
  // Of 640 px, so that the field of view is beyond NARF's; shared by the trials or drawn in each.
  for (const char* focal : {"300", "{uniform: [290, 300]}"}) {
    for (const char* detector : {"paper-rgbd", "{name: paper-rgbd, isolate: true}"}) {
      const std::string text = std::string("name: wide\nrepetitions: 1\nsensors: [rgbd]\n") +
                               "detectors: [" + detector + "]\nfactors:\n  distance_m: 2\n" +
                               "  rgbd_color_focal_px: " + focal + "\n";
      const StudyRun run{.study = ReadStudy(YamlReader::FromText(text, "wide.yaml"), Detectors()),
                         .study_text = text,
                         .out = folder / "out",
                         .restart = true,
                         .detectors = maker};
      EXPECT_THROW(RunStudy(run), InputError) << detector << " " << focal;
    }
  }
}

}  // namespace
}  // namespace fenestra
