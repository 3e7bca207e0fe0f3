// What every command does when what it writes cannot go where it should: exit code 3 where the
// machine failed, 2 where the place was a bad choice, and no file that looks whole and is not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiments/cli/program.h"
#include "tests/experiments/cli/writing_commands.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;
using testing::WritingCommand;

std::vector<WritingCommand> AllCommands() {
  std::vector<WritingCommand> commands = testing::WritingCommands();
  commands.push_back({"fixtures", "fixtures WORK/tiny.yaml --trials 0 --out OUT", {}});
  commands.push_back({"export", "export WORK/tiny.yaml --out OUT/scene.gltf", {}});
  std::erase_if(commands, [](const WritingCommand& command) { return !command.runs_here; });
  return commands;
}

/// Lines of a shell script, which say themselves where the program's output goes.
ProgramOutput Script(const TemporaryFolder& folder, const std::string& lines) {
  return Shell("bash " + folder.Write("script.sh", lines).string());
}

class UnwritableOutputTest : public testing::WritingCommandsTest {
 protected:
  /// The command with a file system of its own mounted onto OUT, and a listing of the empty files
  /// that it leaves there.
  static ProgramOutput OnMount(const std::string& arguments, const std::string& mount) {
    const TemporaryFolder folder;
    const fs::path out = folder / "out";
    fs::create_directory(out);
    return Script(folder, "unshare -m bash -c '" + Placed(mount, out) + " && " + FENESTRA_PROGRAM +
                              " " + Placed(arguments, out) + "; code=$?; find " + out.string() +
                              " -type f -size 0 ! -name .fenestra -printf \"empty: %f\\n\"; "
                              "exit $code'\n");
  }

  static bool CanMount() { return Fenestra("--version; unshare -m true").exit_code == 0; }
};

TEST_F(UnwritableOutputTest, AFullDiskIsNoInputErrorAndLeavesNoEmptyFile) {
  if (!CanMount()) GTEST_SKIP() << "needs the right to mount a file system";
  for (const WritingCommand& command : AllCommands()) {
    // One page for files; folders need none.
    const ProgramOutput output = OnMount(command.arguments, "mount -t tmpfs -o size=4k none OUT");
    EXPECT_EQ(output.exit_code, 3) << command.name << ": " << output.text;
    EXPECT_THAT(output.text, AllOf(AnyOf(HasSubstr("No space left"), HasSubstr("is full"),
                                         HasSubstr("are free")),
                                   Not(HasSubstr("empty: ")), Not(HasSubstr("terminate"))))
        << command.name;
  }
}

TEST_F(UnwritableOutputTest, AFolderForReadingOnlyIsAnInputErrorWithItsReason) {
  if (!CanMount()) GTEST_SKIP() << "needs the right to mount a file system";
  for (const WritingCommand& command : AllCommands()) {
    const ProgramOutput output =
        OnMount(command.arguments, "mount --bind OUT OUT && mount -o remount,ro,bind OUT");
    EXPECT_EQ(output.exit_code, 2) << command.name << ": " << output.text;
    EXPECT_THAT(output.text, AllOf(AnyOf(HasSubstr("Read-only"), HasSubstr("readonly")),
                                   Not(HasSubstr("terminate"))))
        << command.name;
  }
}

// What a command says on standard output is its result, too.
TEST_F(UnwritableOutputTest, LostStandardOutputIsAFailure) {
  for (const char* command :
       {"--help", "--version", "run --help", "list factors", "study check WORK/tiny.yaml",
        "study schema", "pool WORK/result --by distance_m", "report WORK/result --out OUT",
        "run WORK/tiny.yaml --no-pictures --out OUT",
        "check WORK/limits.yaml --results WORK/result",
        "detect stereo --left WORK/sequence/00000/left.png --right WORK/sequence/00000/right.png "
        "--calibration WORK/sequence/00000/calibration.yaml --detector edge-stereo --json"}) {
    for (const char* where : {" > /dev/full", " >&-"}) {
      const TemporaryFolder folder;
      const ProgramOutput lost = Script(folder, std::string(FENESTRA_PROGRAM) + " " +
                                                    Placed(command, folder / "out") + where + "\n");
      EXPECT_EQ(lost.exit_code, 3) << command << where << ": " << lost.text;
      EXPECT_THAT(lost.text, HasSubstr("fenestra: ")) << command << where;
    }
  }
}

// As in "fenestra list factors | head -1", by the signal as for any program, or by the exit code
// where that signal is ignored.
TEST_F(UnwritableOutputTest, AReaderThatHasGoneEndsTheProgram) {
  const TemporaryFolder folder;
  const std::string call = std::string(FENESTRA_PROGRAM) + " list factors";
  const std::string gone = " | true; exit ${PIPESTATUS[0]}\n";
  EXPECT_EQ(Script(folder, "(sleep 0.2; " + call + ")" + gone).exit_code, 128 + 13);
  const ProgramOutput ignored = Script(folder, "trap '' PIPE\n(sleep 0.2; " + call + ")" + gone);
  EXPECT_EQ(ignored.exit_code, 3) << ignored.text;
}

// A log that cannot be written stops no run.
TEST_F(UnwritableOutputTest, LostNotesOnStandardErrorAreNoFailure) {
  const TemporaryFolder folder;
  const std::string call = std::string(FENESTRA_PROGRAM) + " " +
                           Placed("fixtures WORK/tiny.yaml --trials 0 --out OUT", folder / "out");
  EXPECT_EQ(Script(folder, call + " 2> /dev/full\n").exit_code, 0);
  EXPECT_EQ(Script(folder, std::string(FENESTRA_PROGRAM) + " run nothing 2> /dev/full\n").exit_code,
            2);
}

}  // namespace
}  // namespace fenestra
