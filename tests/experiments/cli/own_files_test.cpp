// What every command that writes into a folder does where a user has files of the same names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "tests/experiments/cli/program.h"
#include "tests/experiments/cli/writing_commands.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::ReadFile;
using testing::TemporaryFolder;

using OwnFilesTest = testing::WritingCommandsTest;

std::map<std::string, std::string> ContentOf(const fs::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      content[entry.path().lexically_relative(folder).string()] = ReadFile(entry.path());
    }
  }
  return content;
}

TEST_F(OwnFilesTest, StayWhateverTheirNames) {
  for (const testing::WritingCommand& command : testing::WritingCommands()) {
    for (const std::string& file : command.files) {
      SCOPED_TRACE(command.name + " " + file);
      const TemporaryFolder out;
      out.Write(file, "my own " + file);
      out.Write("pictures/IMG_0001.jpg", "a holiday");
      const ProgramOutput output = Fenestra(Placed(command.arguments, out.path()));
      EXPECT_EQ(output.exit_code, 2) << output.text;
      EXPECT_THAT(output.text, HasSubstr(file));
      const auto now = ContentOf(out.path());
      EXPECT_EQ(now.at(file), "my own " + file);
      EXPECT_EQ(now.at("pictures/IMG_0001.jpg"), "a holiday");
    }
  }
}

TEST_F(OwnFilesTest, OfOtherNamesStayBesideTheResults) {
  for (const testing::WritingCommand& command : testing::WritingCommands()) {
    if (!command.runs_here) continue;
    const TemporaryFolder out;
    out.Write("notes.txt", "mine");
    out.Write("pictures/IMG_0001.jpg", "a holiday");
    for (const char* time : {"first", "again"}) {
      SCOPED_TRACE(command.name + " " + time);
      const ProgramOutput output = Fenestra(Placed(command.arguments, out.path()));
      EXPECT_EQ(output.exit_code, 0) << output.text;
      const auto now = ContentOf(out.path());
      EXPECT_EQ(now.at("notes.txt"), "mine");
      EXPECT_EQ(now.at("pictures/IMG_0001.jpg"), "a holiday");
      for (const std::string& file : command.files) EXPECT_TRUE(now.contains(file)) << file;
    }
  }
}

// A folder that holds results of this program, or of a version that kept no record of its files.
TEST(ResultsFolderTest, AnEditedReportStaysAndOneOfAnEarlierVersionIsReplaced) {
  const TemporaryFolder folder;
  const std::string study = folder.Write("tiny.yaml", testing::kTinyStudy).string();
  const std::string out = (folder / "out").string();
  ASSERT_EQ(Fenestra("run " + study + " --out " + out).exit_code, 0);
  fs::remove(folder / "out/.fenestra");
  folder.Write("out/pictures/IMG_0001.jpg", "a holiday");
  EXPECT_EQ(Fenestra("report " + out).exit_code, 0);
  folder.Write("out/summary.md", "my conclusions");
  for (const std::string& command : {"report " + out, "run " + study + " --restart --out " + out}) {
    const ProgramOutput output = Fenestra(command);
    EXPECT_EQ(output.exit_code, 2) << output.text;
    EXPECT_THAT(output.text, HasSubstr("summary.md"));
    EXPECT_EQ(ReadFile(folder / "out/summary.md"), "my conclusions");
    EXPECT_TRUE(fs::exists(folder / "out/trials.csv"));
  }
  fs::remove(folder / "out/summary.md");
  EXPECT_EQ(Fenestra("run " + study + " --restart --out " + out).exit_code, 0);
  EXPECT_EQ(ReadFile(folder / "out/pictures/IMG_0001.jpg"), "a holiday");
}

TEST(ResultsFolderTest, ScoresDoNotReplaceAStudyOrAnotherSequence) {
  const TemporaryFolder folder;
  const std::string study = folder.Write("tiny.yaml", testing::kTinyStudy).string();
  const std::string out = (folder / "out").string();
  ASSERT_EQ(Fenestra("run " + study + " --no-pictures --out " + out).exit_code, 0);
  ASSERT_EQ(Fenestra("render " + study + " --sequence stereo --out " + (folder / "frames").string())
                .exit_code,
            0);
  const std::string rows = ReadFile(folder / "out/results.sqlite");
  const std::string frames = ReadFile(folder / "frames/sequence.yaml");
  const std::string one =
      folder.Write("frames/one.yaml", frames + "detectors: [edge-stereo]\n").string();
  const std::string two =
      folder.Write("frames/two.yaml", frames + "detectors: [paper-stereo]\n").string();
  const ProgramOutput onto_study = Fenestra("score " + one + " --out " + out);
  EXPECT_EQ(onto_study.exit_code, 2);
  EXPECT_THAT(onto_study.text, HasSubstr("holds another result, of the study 'tiny'"));
  EXPECT_EQ(ReadFile(folder / "out/results.sqlite"), rows);
  EXPECT_EQ(Fenestra("score " + one + " --restart --out " + out).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "out/study.yaml"));
  EXPECT_EQ(Fenestra("score " + one + " --out " + out).exit_code, 0);
  EXPECT_THAT(Fenestra("score " + two + " --out " + out).text,
              HasSubstr("holds another result, of the sequence 'tiny'"));
}

}  // namespace
}  // namespace fenestra
