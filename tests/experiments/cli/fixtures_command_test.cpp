// `fenestra fixtures` as a user meets it.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/experiments/cli/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReadFile;
using testing::TemporaryFolder;

class FixturesCommandTest : public ::testing::Test {
 protected:
  FixturesCommandTest() {
    study_ = folder_
                 .Write("small.yaml",
                        "name: small\nrepetitions: 2\nsensors: [stereo, rgbd]\n"
                        "detectors: [paper-stereo, paper-rgbd]\n"
                        "factors: {distance_m: [2, 3], stereo_width_px: 320,\n"
                        "  stereo_calibration_free_k3: false,\n"
                        "  stereo_height_px: 240, yaw_deg: {uniform: [-2, 2]}}\n")
                 .string();
  }

  std::string Out(const std::string& name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
  std::string study_;
};

TEST_F(FixturesCommandTest, WritesAndVerifiesAndTheOtherCommandsReadIt) {
  const std::string out = Out("out");
  const ProgramOutput made =
      Fenestra(fmt::format("fixtures {} --format all --out {}", study_, out));
  ASSERT_EQ(made.exit_code, 0) << made.text;
  EXPECT_THAT(made.text, AllOf(HasSubstr("4 trials of 'small', about"), HasSubstr("are in")));
  EXPECT_THAT(Fenestra("fixtures --verify " + out).text, HasSubstr("are those that were written"));

  const ProgramOutput scored = Fenestra(
      fmt::format("score {}/stereo.yaml --detector paper-stereo --out {}", out, Out("scored")));
  ASSERT_EQ(scored.exit_code, 0) << scored.text;
  const std::string row = ReadFile(folder_ / "scored/trials.csv");
  EXPECT_THAT(row, HasSubstr("paper-stereo"));
  const std::string observation = out + "/bundle/c002_t0000/observation/";
  const ProgramOutput bundle = Fenestra(fmt::format(
      "detect rgbd --color {0}color.png --depth {0}depth.png --calibration {0}calibration.yaml",
      observation));
  EXPECT_EQ(bundle.exit_code, 0) << bundle.text;
  const std::string sequence = out + "/tum/c002_t0000/";
  const ProgramOutput tum = Fenestra(fmt::format(
      "detect rgbd --color {0}rgb/1000000000.000000.png --depth {0}depth/1000000000.000000.png "
      "--calibration {0}calibration.yaml",
      sequence));
  EXPECT_EQ(tum.exit_code, 0) << tum.text;

  std::string picture = ReadFile(fs::path(observation) / "color.png");
  picture[100] = static_cast<char>(picture[100] ^ 1);
  folder_.Write("out/bundle/c002_t0000/observation/color.png", picture);
  const ProgramOutput damaged = Fenestra("fixtures --verify " + out);
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.text, HasSubstr("color.png: is not the file that was written"));
}

TEST_F(FixturesCommandTest, RecordedTrialsAreThoseOfTheirStudy) {
  ASSERT_EQ(Fenestra(fmt::format("run {} --no-pictures --out {}", study_, Out("run"))).exit_code,
            0);
  const std::string choice = " --trials 1/1 --format euroc --out ";
  ASSERT_EQ(Fenestra("fixtures " + Out("run") + choice + Out("a")).exit_code, 0);
  ASSERT_EQ(Fenestra("fixtures " + study_ + choice + Out("b") + " --jobs 1").exit_code, 0);
  EXPECT_EQ(ReadFile(folder_ / "a/SHA256SUMS"), ReadFile(folder_ / "b/SHA256SUMS"));
}

TEST_F(FixturesCommandTest, ADryRunShowsTrialsAndSizeAndWritesNothing) {
  const ProgramOutput outcome = Fenestra(fmt::format(
      "fixtures {} --trials 0-1 --where 'sensor = rgbd and distance_m = 3' --dry-run --out {}",
      study_, Out("out")));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("3/0 main rgbd distance_m 3\n3/1 main rgbd"),
                    HasSubstr("2 trials of 'small', about"), HasSubstr("nothing was written")));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(FixturesCommandTest, WrongOrdersAreRefused) {
  const fs::path out = folder_ / "out";
  const std::string order = "fixtures " + study_ + " --out " + out.string() + " ";
  ExpectRefused("fixtures", "STUDY: is missing", out);
  ExpectRefused("fixtures " + study_, "--out: is missing", out);
  ExpectRefused("fixtures papre --out " + out.string(), "Did you mean 'paper'?", out);
  ExpectRefused(order + "--trials x", "--trials: 'x' is not a list", out);
  ExpectRefused(order + "--trials 0-2", "cell 0 has no trial 2; it has 0 to 1", out);
  ExpectRefused(order + "--cells 9", "--cells: the study has no cell 9", out);
  ExpectRefused(order + "--where 'distance_m ~ 2'", "--where", out);
  ExpectRefused(order + "--format png", "png not in", out);
  ExpectRefused(order + "--cells 0 --format tum", "tum holds trials of the RGB-D sensor only", out);
  ExpectRefused(order + "--jobs 0", "--jobs", out);
  ExpectRefused(order + "--verify " + out.string(), "--verify: checks fixtures", out);
  ExpectRefused("fixtures --verify " + out.string(), "is no folder of fixtures", out);
  const std::string full = folder_.path().string();
  EXPECT_THAT(Fenestra("fixtures " + study_ + " --out " + full).text,
              HasSubstr("is not empty; fixtures are written into a new or an empty folder"));
  EXPECT_THAT(Fenestra("fixtures --help").text,
              AllOf(HasSubstr("--trials"), HasSubstr("--verify"), Not(HasSubstr("terminate"))));
}

}  // namespace
}  // namespace fenestra
