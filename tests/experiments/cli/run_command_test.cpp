// `fenestra run` that is interrupted, killed, or cannot write; with real sensors and detectors.
// What needs many runs is in run_study_test.cpp.

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

#include "tests/experiments/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReadFile;
using testing::TemporaryFolder;

/// Every column but the times, row by row.
std::string RowsWithoutTimes(const fs::path& results) {
  sqlite3* store = nullptr;
  sqlite3_open_v2((results / "results.sqlite").c_str(), &store, SQLITE_OPEN_READWRITE, nullptr);
  std::string text;
  const auto add = [](void* out, int columns, char** values, char** names) {
    for (int i = 0; i < columns; ++i) {
      if (std::string(names[i]) == "stage_times_s") continue;
      *static_cast<std::string*>(out) += fmt::format("{}|", values[i] ? values[i] : "NULL");
    }
    *static_cast<std::string*>(out) += "\n";
    return 0;
  };
  sqlite3_exec(store, "SELECT * FROM trials ORDER BY cell, trial, detector", add, &text, nullptr);
  sqlite3_close(store);
  return text;
}

class RunCommandTest : public ::testing::Test {
 protected:
  /// Trials of some 30 ms.
  RunCommandTest() { WriteStudy(1, 25); }

  void WriteStudy(int seed, int repetitions) {
    study_ = folder_.Write("small.yaml",
                           fmt::format("name: small\nseed: {}\nrepetitions: {}\n"
                                       "sensors: [stereo]\ndetectors: [paper-stereo]\n"
                                       "factors: {{distance_m: [5, 6], stereo_width_px: 320,\n"
                                       "  stereo_height_px: 240, yaw_deg: {{uniform: [-2, 2]}}}}\n",
                                       seed, repetitions));
  }

  std::string Command(const std::string& out) const {
    return "run " + study_.string() + " --jobs 1 --no-pictures --out " + (folder_ / out).string();
  }

  /// Starts the program without waiting; what it says goes to `said.txt`.
  pid_t Start(const std::string& out) const {
    const pid_t child = fork();
    if (child != 0) return child;
    const int said = open((folder_ / "said.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(said, STDOUT_FILENO);
    dup2(said, STDERR_FILENO);
    const std::string command = "exec " FENESTRA_PROGRAM " " + Command(out);
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }

  int StoredRows(const std::string& out) const {
    const std::string text = RowsWithoutTimes(folder_ / out);
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  }

  void WaitForRows(const std::string& out, int rows) const {
    for (int i = 0; i < 600 && StoredRows(out) < rows; ++i) {
      std::this_thread::sleep_for(milliseconds(100));
    }
  }

  TemporaryFolder folder_;
  fs::path study_;
};

TEST_F(RunCommandTest, AnInterruptEndsCleanlyAndTheSameCommandGoesOn) {
  const pid_t child = Start("out");
  WaitForRows("out", 3);
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  const int stored = StoredRows("out");
  EXPECT_GE(stored, 3);
  ASSERT_LT(stored, 50) << "the run was too quick";
  EXPECT_THAT(ReadFile(folder_ / "said.txt"),
              AllOf(HasSubstr(fmt::format("interrupted; {} of 50 trials are stored", stored)),
                    HasSubstr("The same command goes on")));

  const ProgramOutput rest = Fenestra(Command("out"));
  EXPECT_EQ(rest.exit_code, 0) << rest.text;
  EXPECT_THAT(rest.text, HasSubstr(fmt::format("{} of 50 trials are stored already", stored)));
  const ProgramOutput again = Fenestra(Command("out"));
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.text, HasSubstr("is complete; nothing was run"));
  ASSERT_EQ(Fenestra(Command("whole")).exit_code, 0);
  EXPECT_EQ(RowsWithoutTimes(folder_ / "out"), RowsWithoutTimes(folder_ / "whole"));
}

TEST_F(RunCommandTest, ASecondInterruptEndsAtOnce) {
  const pid_t child = Start("out");
  WaitForRows("out", 1);
  kill(child, SIGINT);
  kill(child, SIGTERM);  // Another kind, and so the first of its own.
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  // Two signals of one kind may become one before the first is handled.
  const bool killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGINT;
  EXPECT_TRUE(killed || (WIFEXITED(status) && WEXITSTATUS(status) == 3));
}

TEST_F(RunCommandTest, AKilledRunGoesOn) {
  for (int rows = 5; rows <= 35; rows += 15) {
    const pid_t child = Start("out");
    WaitForRows("out", rows);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_GE(StoredRows("out"), rows);
  }
  ASSERT_EQ(Fenestra(Command("out")).exit_code, 0);
  ASSERT_EQ(Fenestra(Command("whole")).exit_code, 0);
  EXPECT_EQ(RowsWithoutTimes(folder_ / "out"), RowsWithoutTimes(folder_ / "whole"));
}

TEST_F(RunCommandTest, ADamagedResultIsRefusedAndUntouched) {
  WriteStudy(1, 1);
  ASSERT_EQ(Fenestra(Command("out")).exit_code, 0);
  std::string bytes = ReadFile(folder_ / "out/results.sqlite");
  bytes.replace(4096, 2048, std::string(2048, '\xAA'));
  folder_.Write("out/results.sqlite", bytes);
  for (const std::string more : {"", " --restart"}) {
    const ProgramOutput outcome = Fenestra(Command("out") + more);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr("results.sqlite: "), Not(HasSubstr("terminate"))));
    EXPECT_EQ(ReadFile(folder_ / "out/results.sqlite"), bytes);
  }
}

TEST_F(RunCommandTest, AnotherStudyIsRefusedUntilItShallReplaceTheResult) {
  WriteStudy(1, 1);
  ASSERT_EQ(Fenestra(Command("out")).exit_code, 0);
  const std::string before = ReadFile(folder_ / "out/results.sqlite");
  WriteStudy(2, 1);
  const ProgramOutput refused = Fenestra(Command("out"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.text,
              AllOf(HasSubstr("'seed: 1' there, 'seed: 2' here"), HasSubstr("--restart")));
  EXPECT_EQ(ReadFile(folder_ / "out/results.sqlite"), before);
  EXPECT_EQ(Fenestra(Command("out") + " --restart").exit_code, 0);
  EXPECT_NE(ReadFile(folder_ / "out/results.sqlite"), before);
}

TEST_F(RunCommandTest, AFullDiskEndsTheRunAndWhatIsStoredStays) {
  // A file system of its own that holds the empty store and few rows more.
  const std::string out = (folder_ / "out").string();
  fs::create_directory(out);
  const std::string mount = "unshare -m sh -c 'mount -t tmpfs -o size=160k none " + out + " && ";
  if (Shell(mount + "true'").exit_code != 0) {
    GTEST_SKIP() << "needs the right to mount a file system";
  }
  WriteStudy(1, 100);
  const ProgramOutput outcome =
      Shell(mount + FENESTRA_PROGRAM " " + Command("out") + "; code=$?; cp " + out +
            "/results.sqlite " + (folder_ / "kept").string() + "; ls " + out + "; exit $code'");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("results.sqlite: "), HasSubstr("full"), Not(HasSubstr("terminate"))));
  // On a larger disk the run goes on.
  fs::create_directory(folder_ / "moved");
  fs::rename(folder_ / "kept", folder_ / "moved/results.sqlite");
  const int kept = StoredRows("moved");
  EXPECT_GT(kept, 0);
  EXPECT_LT(kept, 200);
  const ProgramOutput rest = Fenestra(Command("moved"));
  EXPECT_EQ(rest.exit_code, 0);
  EXPECT_THAT(rest.text, HasSubstr(fmt::format("{} of 200 trials are stored already", kept)));
}

TEST_F(RunCommandTest, AFolderThatCannotBeWrittenIsRefused) {
  WriteStudy(1, 1);
  ASSERT_EQ(Fenestra(Command("out")).exit_code, 0);
  const std::string before = ReadFile(folder_ / "out/results.sqlite");
  // Root may write everywhere but on a file system that is mounted for reading only.
  const std::string out = (folder_ / "out").string();
  const std::string mount = fmt::format(
      "unshare -m sh -c 'mount --bind {0} {0} && mount -o remount,ro,bind {0} && ", out);
  if (Shell(mount + "true'").exit_code != 0) {
    GTEST_SKIP() << "needs the right to mount a file system";
  }
  const auto run = [&](const std::string& more) {
    return Shell(mount + FENESTRA_PROGRAM " " + Command("out") + more + "'");
  };
  // A complete result needs no writing.
  EXPECT_EQ(run("").exit_code, 0);
  const ProgramOutput restart = run(" --restart");
  EXPECT_EQ(restart.exit_code, 2) << restart.text;
  EXPECT_THAT(restart.text,
              AllOf(HasSubstr("cannot be written: Read-only"), Not(HasSubstr("terminate"))));
  EXPECT_EQ(ReadFile(folder_ / "out/results.sqlite"), before);
  const ProgramOutput fresh = Shell(mount + FENESTRA_PROGRAM " " + Command("out/new") + "'");
  EXPECT_EQ(fresh.exit_code, 2) << fresh.text;
  EXPECT_THAT(fresh.text, HasSubstr("cannot be made"));
}

TEST_F(RunCommandTest, ShardsAreMergedAndAReportIsMadeOfTheRowsAlone) {
  WriteStudy(1, 3);
  ASSERT_EQ(Fenestra(Command("whole")).exit_code, 0);
  for (const char* shard : {"1", "2"}) {
    const ProgramOutput outcome = Fenestra(fmt::format("{} --shard {}/2", Command(shard), shard));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  }
  const std::string in = folder_.path().string();
  const ProgramOutput merged = Fenestra(fmt::format("merge {0}/1 {0}/2 --out {0}/merged", in));
  EXPECT_EQ(merged.exit_code, 0) << merged.text;
  EXPECT_EQ(RowsWithoutTimes(folder_ / "merged"), RowsWithoutTimes(folder_ / "whole"));
  EXPECT_EQ(Fenestra(fmt::format("merge {0}/1 --out {0}/merged", in)).exit_code, 2);

  const ProgramOutput report =
      Fenestra(fmt::format("report {0}/whole/results.sqlite --pictures --out {0}/report", in));
  EXPECT_EQ(report.exit_code, 0) << report.text;
  for (const char* file : {"trials.csv", "summary.csv", "summary.md", "study.yaml"}) {
    EXPECT_EQ(ReadFile(folder_ / "report" / file), ReadFile(folder_ / "whole" / file)) << file;
  }
  EXPECT_TRUE(fs::exists(folder_ / "report/pictures/cell_001_main_stereo/paper-stereo/left.png"));
  EXPECT_EQ(Fenestra("report " + in + "/none").exit_code, 2);
}

TEST_F(RunCommandTest, WrongShardsAndSubmissionsAreRefused) {
  EXPECT_THAT(Fenestra(Command("out") + " --shard 3/2").text, HasSubstr("--shard: must be I/N"));
  EXPECT_EQ(Fenestra(Command("out") + " --shard 0/2").exit_code, 2);
  EXPECT_EQ(Fenestra("submit " + study_.string() + " --shards 2").exit_code, 2);
  EXPECT_EQ(Fenestra("submit " + study_.string() + " --slurm").exit_code, 2);
  EXPECT_EQ(Fenestra("submit " + study_.string() + " --slurm --shards 0").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  const ProgramOutput dry =
      Fenestra("submit " + study_.string() + " --slurm --shards 2 --dry-run --out " +
               (folder_ / "out").string());
  EXPECT_EQ(dry.exit_code, 0) << dry.text;
  EXPECT_THAT(dry.text, AllOf(HasSubstr("--array=1-2"), HasSubstr("afterok:")));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(RunCommandTest, TheExampleReadsAResultWithPythonAlone) {
  WriteStudy(1, 2);
  ASSERT_EQ(Fenestra(Command("out")).exit_code, 0);
  const std::string example = FENESTRA_SOURCE_DIR "/examples/analysis.py ";
  const ProgramOutput outcome = Shell("python3 " + example + (folder_ / "out").string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("small, seed 1"), HasSubstr("distance_m 6"),
                                  HasSubstr("paper-stereo")));
  EXPECT_NE(Shell("python3 " + example + (folder_ / "none").string()).exit_code, 0);
}

}  // namespace
}  // namespace fenestra
