// `fenestra calibrate` and `fenestra emva` as a user meets them.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "core/calibration_io.h"
#include "core/image_io.h"
#include "tests/experiments/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::ReadFile;
using testing::TemporaryFolder;

const std::string kPictures = FENESTRA_SOURCE_DIR "/tests/data/stereo-calibration/";

std::string Calibrate(const std::string& left, const std::string& right, const std::string& rest) {
  return fmt::format("calibrate stereo --left '{}{}' --right '{}{}' {}", kPictures, left, kPictures,
                     right, rest);
}

TEST(CalibrateCommandTest, PicturesOfARealRigGiveFilesThatOthersRead) {
  const TemporaryFolder folder;
  const Outcome outcome = Fenestra(Calibrate(
      "left*.jpg", "right*.jpg", "--corners 9x6 --square-mm 30 --out " + folder.path().string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("RMS"), HasSubstr("left01"), HasSubstr("stereo.yaml")));

  const StereoCalibration told = ReadStereoCalibration(folder / "stereo.yaml");
  EXPECT_NEAR(told.left.parameters().fx_px, 534.0, 3.0);
  EXPECT_NEAR(told.X_RL.translation().norm(), 0.0998, 0.001);
  EXPECT_EQ(ReadCameraInfo(folder / "left.yaml"), told.left);
  EXPECT_EQ(ReadCameraInfo(folder / "right.yaml"), told.right);

  // Rows of the rectified images agree: both rotations are rotations, turned alike relative to the
  // pair's pose; the projections differ by the baseline alone.
  const auto matrix = [&](const char* file, const char* name, int columns) {
    const YAML::Node data = YAML::LoadFile((folder / file).string())[name]["data"];
    cv::Mat1d m(3, columns);
    for (int i = 0; i < 3 * columns; ++i) m(i / columns, i % columns) = data[i].as<double>();
    return m;
  };
  const cv::Mat1d left_R = matrix("left.yaml", "rectification_matrix", 3);
  const cv::Mat1d right_R = matrix("right.yaml", "rectification_matrix", 3);
  const cv::Mat1d left_P = matrix("left.yaml", "projection_matrix", 4);
  const cv::Mat1d right_P = matrix("right.yaml", "projection_matrix", 4);
  EXPECT_LT(cv::norm(left_R * left_R.t(), cv::Mat1d::eye(3, 3)), 1e-9);
  cv::Mat1d X_RL(3, 3);
  for (int i = 0; i < 9; ++i) X_RL(i / 3, i % 3) = told.X_RL.rotation()(i / 3, i % 3);
  EXPECT_LT(cv::norm(right_R * X_RL, left_R), 1e-6);
  EXPECT_NEAR(right_P(0, 3), -right_P(0, 0) * told.X_RL.translation().norm(), 1e-6);
  EXPECT_EQ(left_P(0, 3), 0.0);
  EXPECT_EQ(left_P(1, 2), right_P(1, 2));
  EXPECT_EQ(left_P(0, 0), right_P(0, 0));

  EXPECT_FALSE(ReadColorImage(folder / "residuals.png").empty());
  EXPECT_THAT(ReadFile(folder / "report.md"), HasSubstr("RMS"));
  // 24 parameters, k3 of either camera held.
  EXPECT_THAT(ReadFile(folder / "covariance.csv"), HasSubstr("rotation y [rad]"));
}

TEST(CalibrateCommandTest, WrongInputIsNamedAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  const std::string board = "--corners 9x6 --square-mm 30" + out;
  for (const auto& [command, message] : std::vector<std::pair<std::string, std::string>>{
           {Calibrate("left*.jpg", "right01.jpg", board), "13"},
           {Calibrate("nothing*.jpg", "right*.jpg", board), "nothing*.jpg"},
           {Calibrate("left*.jpg", "right*.jpg", "--corners 9by6 --square-mm 30" + out),
            "COLUMNSxROWS"},
           {Calibrate("left*.jpg", "right*.jpg", "--corners 9x6 --square-mm -30" + out), "square"},
           {Calibrate("left*.jpg", "right*.jpg", "--corners 8x5 --square-mm 30" + out), "8 x 5"},
           {Calibrate("left01.jpg", "right01.jpg", board), "view"},
           {Calibrate("left*.jpg", "right*.jpg",
                      "--corners 9x6 --square-mm 30 --charuco --marker-mm 20" + out),
            "markers"}}) {
    const Outcome outcome = Fenestra(command);
    EXPECT_EQ(outcome.exit_code, 2) << command << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(message)) << command;
    EXPECT_TRUE(folder.IsEmpty()) << command;
  }
}

TEST(EmvaCommandTest, TakesASeriesAndEvaluatesItAgain) {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  const Outcome outcome =
      Fenestra("emva " + in + " --width-px 64 --height-px 48 --exposures 50 --frames 8");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("put in"), HasSubstr("photon_transfer.png")));
  EXPECT_THAT(ReadFile(folder / "emva1288.txt"), HasSubstr("v 4.0"));
  const auto first = nlohmann::json::parse(ReadFile(folder / "results.json"));
  const Outcome again = Fenestra("emva " + in + " --evaluate-only");
  ASSERT_EQ(again.exit_code, 0) << again.text;
  const auto second = nlohmann::json::parse(ReadFile(folder / "results.json"));
  ASSERT_EQ(first.at("figures").size(), second.at("figures").size());
  for (size_t i = 0; i < first.at("figures").size(); ++i) {
    EXPECT_EQ(first["figures"][i]["measured"], second["figures"][i]["measured"]);
  }
  EXPECT_FALSE(ReadColorImage(folder / "photon_transfer.png").empty());
}

TEST(EmvaCommandTest, WrongInputIsNamedAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"--evaluate-only", "emva1288.txt"},
           {"--set stereo_red_noise_e=3", "Did you mean 'stereo_read_noise_e'"},
           {"--set stereo_read_noise_e=low", "low"},
           {"--set stereo_read_noise_e", "FACTOR=VALUE"},
           {"--exposures 2", "exposures"},
           {"--frames 1", "frames"},
           {"--width-px 0", "0 x 480 px"},
           {"--output-bits 12", "bits"},
           {"--wavelength-nm 2000", "nm"}}) {
    const Outcome outcome = Fenestra("emva " + in + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(message)) << arguments;
    EXPECT_TRUE(folder.IsEmpty()) << arguments;
  }
}

}  // namespace
}  // namespace fenestra
