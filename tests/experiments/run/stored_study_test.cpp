#include "experiments/run/stored_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "tests/experiments/cli/program.h"
#include "tests/experiments/run/mock_study.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::MockRun;
using testing::MockStudy;
using testing::ReadFile;
using testing::TemporaryFolder;

std::string PartOf(const fs::path& results) {
  return PartStored(ResultStore::OpenReadOnly(StoreFile(results)), results);
}

// Runs a study that is stopped after so many trials, or a few more.
void RunUntil(const Study& study, const fs::path& out, int most) {
  std::atomic<int> asked = 0;
  StudyRun run = MockRun(study, out);
  run.jobs = 1;
  run.stop = [&asked, most] { return ++asked > most; };
  RunStudy(run);
}

Study UntilStudy() {
  return ReadStudy(YamlReader::FromText("name: mock\nrepetitions: 300\nsensors: [stereo]\n"
                                        "until: {hit_rate: 0.5}\nfactors: {distance_m: [2, 3]}\n",
                                        "mock.yaml"),
                   Detectors());
}

TEST(StoredStudy, AWholeResultLacksNothing) {
  const TemporaryFolder folder;
  RunStudy(MockRun(MockStudy(5), folder / "fixed"));
  EXPECT_EQ(PartOf(folder / "fixed"), "");
  RunStudy(MockRun(UntilStudy(), folder / "until"));  // Fewer than its 600 trials.
  EXPECT_LT(ResultStore::OpenReadOnly(folder / "until/results.sqlite").FinishedTrials().size(),
            600u);
  EXPECT_EQ(PartOf(folder / "until"), "");
}

TEST(StoredStudy, AnInterruptedRunAndAShardSayHowMuchTheyHold) {
  const TemporaryFolder folder;
  RunUntil(MockStudy(40), folder / "interrupted", 11);
  EXPECT_THAT(PartOf(folder / "interrupted"), HasSubstr(" of 120 trials"));
  RunStudy(MockRun(MockStudy(40), folder / "shard", {.index = 2, .count = 8}));
  EXPECT_EQ(PartOf(folder / "shard"), "15 of 120 trials");
  RunUntil(UntilStudy(), folder / "until", 3);
  EXPECT_THAT(PartOf(folder / "until"), HasSubstr(" of at least "));
}

// What is not whole is not judged, and a report of it says so.
TEST(StoredStudy, EveryCommandThatReadsAResultSaysWhatItLacks) {
  const TemporaryFolder folder;
  RunStudy(MockRun(MockStudy(40), folder / "shard", {.index = 2, .count = 8}));
  const std::string results = (folder / "shard").string();
  const std::string limits = folder.Write("limits.yaml", "limits: [rate(hit) >= 0]\n").string();
  const ProgramOutput check =
      Fenestra("check " + limits + " --results " + results + " --junit " + results + "/junit.xml");
  EXPECT_EQ(check.exit_code, 3);
  EXPECT_THAT(check.text, HasSubstr("holds 15 of 120 trials"));
  EXPECT_FALSE(fs::exists(folder / "shard/junit.xml"));
  for (const std::string& command :
       {"report " + results, "ratios " + results + " --factor distance_m", "pool " + results}) {
    const ProgramOutput output = Fenestra(command);
    EXPECT_EQ(output.exit_code, 0) << output.text;
    EXPECT_THAT(output.text, HasSubstr("holds 15 of 120 trials"));
  }
  EXPECT_THAT(ReadFile(folder / "shard/summary.md"), HasSubstr("15 of 120 trials"));
}

}  // namespace
}  // namespace fenestra
