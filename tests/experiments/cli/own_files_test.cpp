// What every command that writes into a folder does where a user has files of the same names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "tests/experiments/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::ReadFile;
using testing::TemporaryFolder;

constexpr const char* kStudy =
    "name: tiny\nrepetitions: 1\nsensors: [stereo]\ndetectors: [edge-stereo]\n"
    "factors: {distance_m: 2}\n";

/// A command and names that it uses; OUT stands for the folder, WORK for one with a study, its
/// shards, its result and a recorded sequence.
struct WritingCommand {
  std::string name;
  std::string arguments;
  std::vector<std::string> files;
  bool runs_here = true;  ///< False where it takes long or needs what is not here.
};

// Every command that writes into a folder.
const std::vector<WritingCommand> kCommands = {
    {"run",
     "run WORK/tiny.yaml --out OUT --restart",
     {"study.yaml", "trials.csv", "summary.csv", "summary.md", "intervals.csv", "results.sqlite"}},
    {"merge",
     "merge WORK/shard --out OUT --restart",
     {"study.yaml", "trials.csv", "summary.csv", "summary.md", "intervals.csv", "results.sqlite"}},
    {"check", "check WORK/limits.yaml --out OUT", {"study.yaml", "summary.md", "results.sqlite"}},
    {"report",
     "report WORK/result --out OUT --pictures",
     {"study.yaml", "trials.csv", "summary.csv", "summary.md", "intervals.csv"}},
    {"score",
     "score WORK/sequence/sequence_with_detectors.yaml --out OUT --restart",
     {"trials.csv", "summary.csv", "summary.md", "results.sqlite"}},
    {"render_trial",
     "render WORK/tiny.yaml --out OUT",
     {"left.png", "calibration.yaml", "truth/truth.json"}},
    {"render_sequence",
     "render WORK/tiny.yaml --sequence stereo --out OUT",
     {"sequence.yaml", "00000/left.png"}},
    {"replay",
     "replay WORK/result 0/0 --out OUT",
     {"left.png", "calibration.yaml", "truth/trial.yaml"}},
    {"emva",
     "emva OUT --exposures 10 --frames 16 --width-px 64 --height-px 48",
     {"report.md", "results.json", "photon_transfer.png", "emva1288.txt"}},
    {"depth", "depth OUT", {"depth_curves.md", "depth_curves.png"}, false},
    {"calibrate",
     "calibrate stereo --left WORK/sequence/00000/left.png --right "
     "WORK/sequence/00000/right.png --corners 9x6 --square-mm 30 --out OUT",
     {"stereo.yaml", "report.md", "residuals.png"},
     false},
    {"submit",
     "submit WORK/tiny.yaml --slurm --shards 2 --out OUT",
     {"slurm/study.yaml", "slurm/array.sh", "slurm/merge.sh"},
     false},
    {"detect",
     "detect stereo --left WORK/sequence/00000/left.png --right "
     "WORK/sequence/00000/right.png "
     "--calibration WORK/sequence/00000/calibration.yaml --detector edge-stereo --pictures OUT",
     {"2_segments.png"}}};

class OwnFilesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    work_ = new TemporaryFolder;
    work_->Write("tiny.yaml", kStudy);
    work_->Write("limits.yaml", "study: tiny.yaml\nlimits: [rate(hit) >= 0.1]\n");
    for (const char* command : {"run WORK/tiny.yaml --no-pictures --out WORK/result",
                                "run WORK/tiny.yaml --no-pictures --shard 1/1 --out WORK/shard",
                                "render WORK/tiny.yaml --sequence stereo --out WORK/sequence"}) {
      const ProgramOutput output = Fenestra(Placed(command, ""));
      ASSERT_EQ(output.exit_code, 0) << command << output.text;
    }
    work_->Write("sequence/sequence_with_detectors.yaml",
                 ReadFile(*work_ / "sequence/sequence.yaml") + "detectors: [edge-stereo]\n");
  }
  static void TearDownTestSuite() {
    delete work_;
    work_ = nullptr;
  }

  static std::string Placed(std::string text, const fs::path& out) {
    for (const auto& [word, path] : {std::pair("WORK", work_->path()), std::pair("OUT", out)}) {
      for (size_t at = text.find(word); at != std::string::npos; at = text.find(word)) {
        text.replace(at, std::string(word).size(), path.string());
      }
    }
    return text;
  }

  static TemporaryFolder* work_;
};

TemporaryFolder* OwnFilesTest::work_ = nullptr;

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
  for (const WritingCommand& command : kCommands) {
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
  for (const WritingCommand& command : kCommands) {
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
  const std::string study = folder.Write("tiny.yaml", kStudy).string();
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
  const std::string study = folder.Write("tiny.yaml", kStudy).string();
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
