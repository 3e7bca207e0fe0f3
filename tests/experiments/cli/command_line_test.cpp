// The program as a user meets it, in a process of its own.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReadFile;
using testing::TemporaryFolder;

constexpr const char* kStudy =
    "name: tiny\n"
    "repetitions: 1\n"
    "sensors: [rgbd]\n"
    "factors:\n"
    "  distance_m: [1.4]\n";

TEST(CommandLineTest, HelpIsEverywhereAndHasAnExample) {
  for (const char* command : {"",
                              "run",
                              "render",
                              "replay",
                              "detect",
                              "detect stereo",
                              "detect rgbd",
                              "list",
                              "export",
                              "calibrate",
                              "calibrate stereo",
                              "emva",
                              "depth",
                              "bound",
                              "merge",
                              "submit",
                              "report",
                              "score",
                              "serve",
                              "validate"}) {
    const ProgramOutput outcome = Fenestra(std::string(command) + " --help");
    EXPECT_EQ(outcome.exit_code, 0) << command;
    EXPECT_THAT(outcome.text, HasSubstr("Example")) << command;
  }
}

TEST(CommandLineTest, TheVersionNamesTheLibraries) {
  EXPECT_THAT(Fenestra("--version").text, AllOf(HasSubstr("fenestra 0."), HasSubstr("Embree 3."),
                                                HasSubstr("OpenCV 4."), HasSubstr("PCL 1.")));
}

TEST(CommandLineTest, UnknownWordsGetAHint) {
  EXPECT_THAT(Fenestra("rum paper").text, HasSubstr("Did you mean 'run'?"));
  EXPECT_THAT(Fenestra("run paper --job 2").text, HasSubstr("Did you mean '--jobs'?"));
  EXPECT_THAT(Fenestra("run papr").text, HasSubstr("Did you mean 'paper'?"));
  EXPECT_EQ(Fenestra("rum paper").exit_code, 2);
  EXPECT_EQ(Fenestra("run paper --job 2").exit_code, 2);
  EXPECT_EQ(Fenestra("").exit_code, 2);
  EXPECT_EQ(Fenestra("run paper --jobs many").exit_code, 2);
}

TEST(CommandLineTest, ListsShowWhatThereIs) {
  EXPECT_THAT(Fenestra("list detectors").text,
              AllOf(HasSubstr("paper-stereo"), HasSubstr("paper-rgbd")));
  EXPECT_THAT(Fenestra("list factors").text, HasSubstr("distance_m"));
  EXPECT_THAT(Fenestra("list studies").text, HasSubstr("paper"));
}

class BadStudyTest : public ::testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(BadStudyTest, IsRefusedWithItsPlaceAndLeavesNothing) {
  const auto& [text, message] = GetParam();
  const TemporaryFolder folder;
  const auto study = folder.Write("bad.yaml", text);
  const auto out = folder / "out";
  const ProgramOutput outcome = Fenestra("run " + study.string() + " --out " + out.string());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr(message));
  EXPECT_THAT(outcome.text, Not(HasSubstr("terminate")));
  EXPECT_FALSE(std::filesystem::exists(out));
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, BadStudyTest,
    ::testing::Values(
        std::pair{"name: a\nrepetitons: 3\n", "bad.yaml:2:1: unknown key 'repetitons'"},
        std::pair{"name: a\nrepetitions: many\n", "bad.yaml:2:14: "},
        std::pair{"name: a\nfactors: {distance_m: near}\n", "bad.yaml:2:23: "},
        std::pair{"name: a\nfactors: {window_width_m: -1}\n", "bad.yaml:2:27: "},
        std::pair{"name: a\nfactors: {distance_m: 1e9}\n", "bad.yaml:2:23: "},
        std::pair{"name: a\nfactors: {distnace_m: 2}\n", "Did you mean 'distance_m'?"},
        std::pair{"name: a\nsensors: [lidar]\n", "bad.yaml:2:"},
        std::pair{"name: a\ndetectors: [paper-sterio]\n", "Did you mean 'paper-stereo'?"},
        std::pair{"name: a\nfactors: [1, 2\n", "bad.yaml:"}, std::pair{"", "the file is empty"},
        std::pair{"- 1\n- 2\n", "bad.yaml:1:1: "}));

TEST(CommandLineTest, MissingAndHugeFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder / "out").string();
  EXPECT_EQ(Fenestra("run " + (folder / "none.yaml").string() + out).exit_code, 2);
  EXPECT_EQ(Fenestra("run " + folder.path().string() + out).exit_code, 2);
  const auto zeros = folder.Write("zeros.yaml", std::string(100 << 20, '\0'));
  const ProgramOutput outcome = Fenestra("run " + zeros.string() + out);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("at most"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(CommandLineTest, RunReplayRenderAndDetectAgree) {
  const TemporaryFolder folder;
  const std::string study = folder.Write("tiny.yaml", kStudy).string();
  const std::string out = (folder / "out").string();
  const ProgramOutput run = Fenestra("run " + study + " --out " + out + " --jobs 2");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("paper-rgbd"));
  EXPECT_THAT(run.text, Not(HasSubstr("\r")));  // A progress bar is for terminals.

  const ProgramOutput replay = Fenestra("replay " + out + " 0/0");
  EXPECT_EQ(replay.exit_code, 0);
  EXPECT_THAT(replay.text, HasSubstr("equal the recorded ones"));
  EXPECT_EQ(Fenestra("replay " + out + " 0/7").exit_code, 2);
  EXPECT_EQ(Fenestra("replay " + out + " zero").exit_code, 2);

  const std::string files = (folder / "trial").string();
  ASSERT_EQ(Fenestra("render " + study + " --out " + files).exit_code, 0);
  const ProgramOutput detect =
      Fenestra("detect rgbd --color " + files + "/color.png --depth " + files +
               "/depth.png --calibration " + files + "/calibration.yaml --json");
  ASSERT_EQ(detect.exit_code, 0) << detect.text;
  const auto found = nlohmann::json::parse(detect.text);
  ASSERT_EQ(found["outcome"], "window");
  const auto truth = nlohmann::json::parse(ReadFile(folder / "trial/truth/truth.json"));
  EXPECT_NEAR(found["centroid_m"][2].get<double>(), truth["target"]["centroid_m"][2].get<double>(),
              0.1);
}

TEST(CommandLineTest, AnExportedSceneRendersWithTheTruthOfItsTrial) {
  const TemporaryFolder folder;
  const std::string study = folder.Write("tiny.yaml", kStudy).string();
  const std::string scene = (folder / "scene.glb").string();
  ASSERT_EQ(Fenestra("export " + study + " --out " + scene).exit_code, 0);
  const std::string views = (folder / "views").string();
  const ProgramOutput render = Fenestra(
      "render " + scene + " --camera depth --sky cie_overcast --sun-lx 1000 --out " + views);
  ASSERT_EQ(render.exit_code, 0) << render.text;
  EXPECT_TRUE(std::filesystem::exists(folder / "views/depth/color.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "views/depth/scene.exr"));
  ASSERT_EQ(Fenestra("render " + study + " --out " + (folder / "trial").string()).exit_code, 0);
  const auto of_trial = nlohmann::json::parse(ReadFile(folder / "trial/truth/truth.json"));
  const auto of_scene = nlohmann::json::parse(ReadFile(folder / "views/depth/truth.json"));
  for (const size_t axis : {0u, 1u, 2u}) {
    EXPECT_NEAR(of_scene["target"]["centroid_m"][axis].get<double>(),
                of_trial["target"]["centroid_m"][axis].get<double>(), 1e-12);
  }
  EXPECT_THAT(Fenestra("render " + scene + " --camera depht --out " + views).text,
              HasSubstr("Did you mean 'depth'?"));
}

TEST(CommandLineTest, BrokenSceneFilesAreRefusedWithTheirPlace) {
  const TemporaryFolder folder;
  const std::string broken =
      folder.Write("broken.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 7}]})")
          .string();
  const std::string out = (folder / "out").string();
  const ProgramOutput outcome = Fenestra("render " + broken + " --out " + out);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("/nodes/0/mesh"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  EXPECT_EQ(Fenestra("render " + (folder / "missing.glb").string() + " --out " + out).exit_code, 2);
  EXPECT_EQ(Fenestra("export paper --cell 99 --out " + (folder / "x.glb").string()).exit_code, 2);
  EXPECT_EQ(Fenestra("export paper --out " + (folder / "x.obj").string()).exit_code, 2);
}

TEST(CommandLineTest, DetectRefusesWhatItCannotUse) {
  const TemporaryFolder folder;
  EXPECT_EQ(Fenestra("detect stereo --left a.png --right b.png --calibration c.yaml").exit_code, 2);
  EXPECT_EQ(Fenestra("detect rgbd --color a.png").exit_code, 2);
  EXPECT_EQ(Fenestra("render paper --cell 9999 --out " + (folder / "x").string()).exit_code, 2);
  EXPECT_TRUE(folder.IsEmpty());
}

TEST(CommandLineTest, HelpForAnUnknownWordIsAnError) {
  for (const auto& [command, hint] : std::vector<std::pair<std::string, std::string>>{
           {"rnu --help", "Did you mean 'run'?"},
           {"--help rnu", "Did you mean 'run'?"},
           {"rnu --version", "Did you mean 'run'?"},
           {"detect strreo --help", "Did you mean 'stereo'?"},
           {"run --job 2 --help", "Did you mean '--jobs'?"},
           {"detect '[x]' --help", "'[x]'"}}) {
    const ProgramOutput outcome = Fenestra(command);
    EXPECT_EQ(outcome.exit_code, 2) << command << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(hint)) << command;
  }
  EXPECT_EQ(Fenestra("run paper --help").exit_code, 0);
}

TEST(CommandLineTest, BracketsStayWhereListsAreTaken) {
  const TemporaryFolder folder;
  const ProgramOutput merge = Fenestra("merge '[a]' '[b,c]' --out " + (folder / "o").string());
  EXPECT_EQ(merge.exit_code, 2);
  EXPECT_THAT(merge.text, HasSubstr("[a]"));
  EXPECT_THAT(Fenestra("score '[s].yaml'").text, HasSubstr("[s].yaml: no such file"));
  EXPECT_THAT(Fenestra("pool '[r]'").text, HasSubstr("[r]"));
}

TEST(CommandLineTest, ScenesMayHaveExtensionsInCapitals) {
  const TemporaryFolder folder;
  const std::string study = folder.Write("TINY.YAML", kStudy).string();
  const std::string scene = (folder / "SCENE.GLB").string();
  ASSERT_EQ(Fenestra("export " + study + " --out " + scene).exit_code, 0);
  const ProgramOutput render =
      Fenestra("render " + scene + " --camera depth --out " + (folder / "views").string());
  EXPECT_EQ(render.exit_code, 0) << render.text;
}

// One frame as files, and what becomes of them.
class DetectInputTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string study = folder_.Write("tiny.yaml", kStudy).string();
    ASSERT_EQ(Fenestra("render " + study + " --out " + files_).exit_code, 0);
  }

  ProgramOutput Detect(const std::string& calibration, const std::string& more = "") const {
    return Fenestra("detect rgbd --color " + files_ + "/color.png --depth " + files_ +
                    "/depth.png --calibration " + calibration + " " + more);
  }

  TemporaryFolder folder_;
  std::string files_ = (folder_ / "trial").string();
};

TEST_F(DetectInputTest, ADepthScaleIsInUnitsPerMetre) {
  const std::string own = files_ + "/calibration.yaml";
  EXPECT_EQ(Detect(own, "--depth-scale 1000").exit_code, 0);
  for (const char* scale : {"0.001", "10", "1e9"}) {
    const ProgramOutput outcome = Detect(own, std::string("--depth-scale ") + scale);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("a unit of depth must be")) << scale;
  }
}

TEST_F(DetectInputTest, AnAssumedDepthUnitIsNoted) {
  std::string text = ReadFile(files_ + "/calibration.yaml");
  text.resize(text.find("depth_unit_m"));
  const std::string silent = folder_.Write("silent.yaml", text).string();
  EXPECT_THAT(Detect(silent).text, HasSubstr("silent.yaml states no depth_unit_m: units of 1 mm"));
  EXPECT_THAT(Detect(silent, "--depth-scale 1000").text, Not(HasSubstr("note")));
  EXPECT_THAT(Detect(files_ + "/calibration.yaml").text, Not(HasSubstr("note")));
}

TEST(CommandLineTest, AReplayElsewhereNamesTheFolderInWhichItsProgramIsFound) {
  const TemporaryFolder folder;
  folder.Write("mine", "#!/bin/sh\nexec " FENESTRA_PROGRAM " serve edge-stereo\n");
  std::filesystem::permissions(folder / "mine", std::filesystem::perms::all);
  folder.Write("mine.yaml",
               "name: mine\nrepetitions: 1\nsensors: [stereo]\nfactors: {distance_m: 2}\n"
               "detectors:\n  - {name: mine, command: [./mine], sensor: stereo}\n");
  const std::string in = folder.path().string();
  const std::string run = "cd " + in + " && " FENESTRA_PROGRAM " run mine.yaml --out out";
  ASSERT_EQ(std::system((run + " > /dev/null 2>&1").c_str()), 0);
  const ProgramOutput elsewhere = Fenestra("replay " + in + "/out 0/0");
  EXPECT_EQ(elsewhere.exit_code, 3);
  EXPECT_THAT(elsewhere.text,
              HasSubstr("folder from which the detector is started: recorded '" + in + "'"));
}

}  // namespace
}  // namespace fenestra
