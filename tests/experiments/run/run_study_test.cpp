// Runs that are interrupted, killed, continued and refused. Sensor and detectors are mocks, so that
// many runs fit into seconds; command_line_test.cpp has the same with the real program.

#include "experiments/run/run_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <set>
#include <thread>

#include "core/random/random_stream.h"
#include "tests/experiments/run/mock_study.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::MockRun;
using testing::MockRunner;
using testing::MockStudy;
using testing::ReadFile;
using testing::Refusal;
using testing::RowsIn;
using testing::TemporaryFolder;

/// A mock whose trials take a millisecond.
std::shared_ptr<const TrialRunner> MakeSlowRunner(const Study& study, const Cell& cell) {
  class SlowRunner : public TrialRunner {
   public:
    SlowRunner(const Study& s, const Cell& c) : quick_(s, c) {}
    const Cell& cell() const override { return quick_.cell(); }
    const std::vector<DetectorChoice>& detectors() const override { return quick_.detectors(); }
    SimulatedTrial Simulate(int trial) const override {
      std::this_thread::sleep_for(milliseconds(1));
      return quick_.Simulate(trial);
    }
    Attempt Try(size_t detector, const SimulatedTrial& s, bool keep) const override {
      return quick_.Try(detector, s, keep);
    }
    std::optional<ExplainedDepth> DepthOf(const SimulatedTrial& simulated) const override {
      return quick_.DepthOf(simulated);
    }
    TrueSensor SensorOf(const SimulatedTrial& s) const override { return quick_.SensorOf(s); }
    TruthImages TruthOf(const SimulatedTrial& s) const override { return quick_.TruthOf(s); }

   private:
    MockRunner quick_;
  };
  return std::make_shared<const SlowRunner>(study, cell);
}

TEST(RunStudyTest, ARunThatWasStoppedGoesOnAndGivesTheRowsOfOneThatWasNot) {
  const TemporaryFolder folder;
  const Study study = MockStudy(40);
  RunStudy(MockRun(study, folder / "whole"));
  StudyRun run = MockRun(study, folder / "parts");
  int64_t stored = 0;
  std::atomic<int> calls = 0;  // Both jobs ask.
  for (int part = 0; part < 3; ++part) {
    run.stop = [&calls] { return ++calls % 20 == 0; };
    const StudyResult result = RunStudy(run);
    EXPECT_EQ(result.trials, 120);
    EXPECT_EQ(result.stored_before, stored);
    EXPECT_GT(result.stored, stored);
    EXPECT_FALSE(result.complete());
    EXPECT_FALSE(std::filesystem::exists(run.out / "summary.md"));
    stored = result.stored;
  }
  run.stop = [] { return false; };
  EXPECT_TRUE(RunStudy(run).complete());
  EXPECT_EQ(RowsIn(run.out), RowsIn(folder / "whole"));
  EXPECT_EQ(ReadFile(run.out / "trials.csv"), ReadFile(folder / "whole/trials.csv"));
  EXPECT_EQ(ResultStore::OpenReadOnly(run.out / "results.sqlite").Runs().size(), 4u);
}

TEST(RunStudyTest, ACompleteResultIsLeftAsItIs) {
  const TemporaryFolder folder;
  StudyRun run = MockRun(MockStudy(2), folder / "out");
  const StudyResult first = RunStudy(run);
  const std::string before = ReadFile(run.out / "results.sqlite");
  run.make_runner = [](const Study&, const Cell&) -> std::shared_ptr<const TrialRunner> {
    throw std::logic_error("a trial was run");
  };
  const StudyResult second = RunStudy(run);
  EXPECT_EQ(second.stored_before, second.trials);
  EXPECT_EQ(SummaryCsv(second.summaries), SummaryCsv(first.summaries));
  EXPECT_EQ(ReadFile(run.out / "results.sqlite"), before);
  // A run that was killed before its last lines.
  std::filesystem::remove(run.out / "trials.csv");
  EXPECT_EQ(SummaryCsv(RunStudy(run).summaries), SummaryCsv(first.summaries));
  EXPECT_TRUE(std::filesystem::exists(run.out / "trials.csv"));
}

TEST(RunStudyTest, AnotherResultIsNamedAndUntouchedUntilItIsReplacedOnPurpose) {
  const TemporaryFolder folder;
  const auto out = folder / "out";
  RunStudy(MockRun(MockStudy(2), out));
  const std::string before = ReadFile(out / "results.sqlite");

  EXPECT_THAT(Refusal([&] { RunStudy(MockRun(MockStudy(2, 4), out)); }),
              AllOf(HasSubstr("'seed: 3' there, 'seed: 4' here"), HasSubstr("--restart")));
  EXPECT_THAT(Refusal([&] { RunStudy(MockRun(MockStudy(3), out)); }),
              HasSubstr("'main: repetitions: 2' there, 'main: repetitions: 3' here"));
  StudyRun shard = MockRun(MockStudy(2), out);
  shard.shard = {1, 2};
  EXPECT_THAT(Refusal([&] { RunStudy(shard); }), HasSubstr("shard: 1/1 there, 1/2 here"));
  EXPECT_EQ(ReadFile(out / "results.sqlite"), before);

  StudyRun other = MockRun(MockStudy(3), out);
  other.restart = true;
  const StudyResult result = RunStudy(other);
  EXPECT_EQ(result.stored_before, 0);
  EXPECT_EQ(result.stored, 9);
}

TEST(RunStudyTest, ADescriptionMayChange) {
  const TemporaryFolder folder;
  Study study = MockStudy(2);
  RunStudy(MockRun(study, folder / "out"));
  study.description = "What it asks.";
  EXPECT_EQ(RunStudy(MockRun(study, folder / "out")).stored_before, 6);
}

TEST(RunStudyTest, TwoRunsIntoOneFolderAreKeptApart) {
  const TemporaryFolder folder;
  StudyRun run = MockRun(MockStudy(2), folder / "out");
  const StudyRun second = MockRun(MockStudy(2), folder / "out");
  std::string refusal;
  run.on_start = [&](const RunStart&) { refusal = Refusal([&] { RunStudy(second); }); };
  EXPECT_TRUE(RunStudy(run).complete());
  EXPECT_THAT(refusal, HasSubstr("another process is running a study into this folder"));
}

TEST(RunStudyTest, TheFirstTrialThatCannotBeStoredEndsTheRun) {
  const TemporaryFolder folder;
  StudyRun run = MockRun(MockStudy(200), folder / "out");
  run.store_interval = milliseconds(1);
  run.make_runner = MakeSlowRunner;
  run.on_stored = [](auto) { throw InputError("disk", "is full"); };
  EXPECT_THAT(Refusal([&] { RunStudy(run); }), HasSubstr("disk: is full"));
  EXPECT_LT(ResultStore::OpenReadOnly(run.out / "results.sqlite").FinishedTrials().size(), 600u);
}

/// The trials of whole lines; the last line may be cut.
std::set<TrialKey> ReadReported(const std::filesystem::path& file) {
  const std::string text = ReadFile(file);
  std::istringstream lines(text.substr(0, text.rfind('\n') + 1));
  std::set<TrialKey> keys;
  for (TrialKey key; lines >> key.cell >> key.trial;) keys.insert(key);
  return keys;
}

/// A run in a process of its own, which notes in `reported` the trials that are reported as stored.
pid_t StartRun(StudyRun run, const std::filesystem::path& reported) {
  const pid_t child = fork();
  if (child != 0) return child;
  FILE* notes = fopen(reported.c_str(), "a");
  run.on_stored = [notes](std::span<const TrialRecord> rows) {
    fprintf(notes, "%d %d\n", rows[0].cell, rows[0].trial);
    fflush(notes);
  };
  RunStudy(run);
  _exit(0);
}

/// Waits until so many trials are reported, however slow the machine is; then kills. Returns
/// whether the run had ended by itself.
bool KillAfter(pid_t child, size_t trials, std::chrono::microseconds delay,
               const std::filesystem::path& reported) {
  for (int i = 0; i < 30'000 && ReadReported(reported).size() < trials; ++i) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  std::this_thread::sleep_for(delay);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status);
}

TEST(RunStudyTest, FiftyKillsAtRandomMomentsLoseNothingAndDoubleNothing) {
  const TemporaryFolder folder;
  const Study study = MockStudy(1000);
  StudyRun run = MockRun(study, folder / "killed");
  run.make_runner = MakeSlowRunner;
  run.store_interval = milliseconds(3);
  folder.Write("reported", "");
  const RandomStream random(50);
  for (uint64_t i = 0; i < 50; ++i) {
    // 0 to 30 trials and up to 10 ms more: while the store is made or opened, in and between
    // commits.
    const auto more = static_cast<size_t>(31 * random.Uniform(2 * i));
    const auto delay = std::chrono::microseconds(static_cast<int>(1e4 * random.Uniform(2 * i + 1)));
    const size_t before = ReadReported(folder / "reported").size();
    const pid_t child = StartRun(run, folder / "reported");
    ASSERT_FALSE(KillAfter(child, before + more, delay, folder / "reported")) << "kill " << i;
    if (!std::filesystem::exists(run.out / "results.sqlite")) continue;
    const auto stored = ResultStore::OpenReadOnly(run.out / "results.sqlite").FinishedTrials();
    const std::set<TrialKey> reported = ReadReported(folder / "reported");
    EXPECT_TRUE(std::includes(stored.begin(), stored.end(), reported.begin(), reported.end()));
  }
  const int64_t before = RunStudy(run).stored_before;
  EXPECT_GT(before, 300);   // The kills left something to lose,
  EXPECT_LT(before, 3000);  // and something to do.
  RunStudy(MockRun(study, folder / "whole"));
  EXPECT_EQ(RowsIn(run.out), RowsIn(folder / "whole"));
}

}  // namespace
}  // namespace fenestra
