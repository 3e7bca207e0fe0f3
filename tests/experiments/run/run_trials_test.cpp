#include "experiments/run/run_trials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>

#include "experiments/report/report.h"
#include "experiments/run/replay.h"
#include "experiments/run/run_study.h"
#include "experiments/store/store.h"
#include "experiments/study_file/study_reader.h"
#include "tests/support/temporary_folder.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

using testing::ReadFile;
using testing::TemporaryFolder;

constexpr const char* kStudy =
    "name: small\n"
    "seed: 3\n"
    "repetitions: 2\n"
    "sensors: [stereo, rgbd]\n"
    "factors:\n"
    "  distance_m: [1.5, 2.5]\n"
    "  window_width_m: 0.8\n"
    "  window_height_m: 0.8\n"
    "  yaw_deg: {uniform: [-2, 2]}\n"
    "  wall_reflectance: {uniform: [0.7, 0.9]}\n";

Study SmallStudy() {
  return ReadStudy(YamlReader::FromText(kStudy, "small.yaml"), Detectors());
}

// All rows without their timings, in the order of their keys.
std::string Rows(const Study& study, std::vector<TrialKey> order, int jobs) {
  const std::vector<Cell> cells = Cells(study);
  std::vector<TrialRecord> rows;
  std::mutex mutex;
  RunTrials(study, cells, order, {.jobs = jobs}, [&](const FinishedTrial& trial) {
    const std::lock_guard lock(mutex);
    for (TrialRecord record : trial.Records()) {
      record.stages.clear();
      rows.push_back(record);
    }
  });
  std::sort(rows.begin(), rows.end(), [](const TrialRecord& a, const TrialRecord& b) {
    return std::tie(a.cell, a.trial, a.detector) < std::tie(b.cell, b.trial, b.detector);
  });
  return TrialsCsv(rows);  // Numbers in a form that reads back exactly.
}

TEST(RunTrialsTest, RowsDoNotDependOnTheNumberOfJobsOrTheOrder) {
  const Study study = SmallStudy();
  std::vector<TrialKey> order = AllTrials(Cells(study));
  const std::string one_job = Rows(study, order, 1);
  // Four trials of each sensor, each under two detectors.
  EXPECT_EQ(std::count(one_job.begin(), one_job.end(), '\n'), 1 + 4 * 2 + 4 * 2);
  EXPECT_EQ(Rows(study, order, 2), one_job);
  std::reverse(order.begin(), order.end());
  EXPECT_EQ(Rows(study, order, 1), one_job);
  // The twin: another seed gives other rows.
  Study other = study;
  other.seed = 4;
  EXPECT_NE(Rows(other, order, 2), one_job);
}

TEST(RunTrialsTest, AnExceptionEndsTheRunAndComesOut) {
  const Study study = SmallStudy();
  const std::vector<Cell> cells = Cells(study);
  EXPECT_THROW(RunTrials(study, cells, AllTrials(cells), {.jobs = 2},
                         [](const FinishedTrial&) { throw std::runtime_error("disk full"); }),
               std::runtime_error);
}

TEST(RunStudyTest, LeavesEveryFileAndEveryTrialReplaysToTheLastBit) {
  const TemporaryFolder folder;
  const StudyRun run{.study = SmallStudy(), .study_text = kStudy, .out = folder / "out", .jobs = 2};
  const std::vector<CellSummary> summaries = RunStudy(run).summaries;
  EXPECT_EQ(summaries.size(), 8u);
  for (const char* name : {"results.sqlite", "trials.csv", "summary.csv", "summary.md",
                           "study.yaml", "pictures/cell_000_main_stereo/paper-stereo/left.png",
                           "pictures/cell_002_main_rgbd/paper-rgbd/color.png"}) {
    EXPECT_TRUE(std::filesystem::exists(run.out / name)) << name;
  }
  for (const ReplayedRow& row : Replay(run.out, 2, 1, folder / "replay")) {
    EXPECT_TRUE(row.differences.empty()) << row.differences.front();
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "replay/truth/truth.json"));
}

TEST(RunStudyTest, ASceneWithoutAWindowCountsFalseAlarms) {
  const TemporaryFolder folder;
  const StudyRun run{.study = ReadStudy(YamlReader::FromText(
                                            "name: none\nrepetitions: 1\nsensors: [stereo, rgbd]\n"
                                            "factors: {target: false, distance_m: 1.5}\n",
                                            "none.yaml"),
                                        Detectors()),
                     .study_text = "",
                     .out = folder / "out",
                     .jobs = 2};
  for (const CellSummary& summary : RunStudy(run).summaries) {
    EXPECT_EQ(summary.without_target, 1);
    EXPECT_EQ(summary.in_view, 0);
    EXPECT_EQ(summary.counts[Outcome::kClear] + summary.counts[Outcome::kFalseAlarm], 1);
  }
}

TEST(RunStudyTest, AForeignFileInTheWayIsRefusedAndStays) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "out");
  folder.Write("out/results.sqlite", "somebody else's");
  const StudyRun run{.study = SmallStudy(), .study_text = kStudy, .out = folder / "out"};
  EXPECT_THROW(RunStudy(run), InputError);
  EXPECT_EQ(ReadFile(folder / "out/results.sqlite"), "somebody else's");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/study.yaml"));
}

}  // namespace
}  // namespace fenestra
