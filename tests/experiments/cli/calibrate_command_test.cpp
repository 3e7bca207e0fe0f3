// `fenestra calibrate` as a user meets it.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>

#include "core/geometry/calibration.h"
#include "core/io/image_io.h"
#include "tests/experiments/cli/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::ReadFile;
using ::testing::StartsWith;
using testing::TemporaryFolder;

const std::string kPictures = FENESTRA_SOURCE_DIR "/tests/data/stereo-calibration/";

std::string Calibrate(const std::string& left, const std::string& right, const std::string& rest) {
  return fmt::format("calibrate stereo --left '{}{}' --right '{}{}' {}", kPictures, left, kPictures,
                     right, rest);
}

TEST(CalibrateCommandTest, TheHelpListsItAndItsOptions) {
  EXPECT_THAT(Fenestra("--help").text, HasSubstr("calibrate"));
  EXPECT_THAT(Fenestra("calibrate --help").text, HasSubstr("stereo"));
  const std::string stereo = Fenestra("calibrate stereo --help").text;
  for (const char* option : {"--left", "--right", "--corners", "--square-mm", "--charuco",
                             "--marker-mm", "--free-k3", "--out"}) {
    EXPECT_THAT(stereo, HasSubstr(option));
  }
}

TEST(CalibrateCommandTest, PicturesOfARealRigGiveFilesThatOthersRead) {
  const TemporaryFolder folder;
  const ProgramOutput outcome = Fenestra(Calibrate(
      "left*.jpg", "right*.jpg", "--corners 9x6 --square-mm 30 --out " + folder.path().string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("RMS"), HasSubstr("left01"), HasSubstr("stereo.yaml")));

  const StereoCalibration told = ReadStereoCalibration(folder / "stereo.yaml");
  EXPECT_NEAR(told.left.parameters().fx_px, 534.0, 3.0);
  EXPECT_NEAR(told.X_RL.translation().norm(), 0.0998, 0.001);
  // As OpenCV's own programs read it.
  const cv::FileStorage storage((folder / "stereo.yaml").string(), cv::FileStorage::READ);
  ASSERT_TRUE(storage.isOpened());
  cv::Mat1d K1;
  cv::Mat1d D2;
  cv::Mat1d R;
  cv::Mat1d T;
  storage["K1"] >> K1;
  storage["D2"] >> D2;
  storage["R"] >> R;
  storage["T"] >> T;
  EXPECT_EQ(static_cast<int>(storage["image_width"]), 640);
  EXPECT_EQ(K1(0, 0), told.left.parameters().fx_px);
  EXPECT_EQ(K1(1, 2), told.left.parameters().cy_px);
  EXPECT_EQ(D2(0, 0), told.right.parameters().distortion.k1);
  EXPECT_LT(cv::norm(R * R.t(), cv::Mat1d::eye(3, 3)), 1e-12);
  EXPECT_EQ(cv::norm(T), told.X_RL.translation().norm());
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

TEST(CalibrateCommandTest, WhatItSaysItWroteIsWhatThereIs) {
  const TemporaryFolder folder;
  const ProgramOutput good =
      Fenestra(Calibrate("left0?.jpg", "right0?.jpg",
                         "--corners 9x6 --square-mm 30 --out " + (folder / "rig").string()));
  ASSERT_EQ(good.exit_code, 0) << good.text;
  size_t announced = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "rig")) {
    const std::string name = entry.path().filename();
    if (name.starts_with(".")) continue;  // The record of what was written.
    EXPECT_THAT(good.text, HasSubstr(name));
    ++announced;
  }
  EXPECT_EQ(announced, 6u);
}

TEST(CalibrateCommandTest, WrongInputIsNamedAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto out = folder / "rig";
  const std::string to = " --out " + out.string();
  const std::string board = "--corners 9x6 --square-mm 30" + to;
  const auto corners = [&](const std::string& text) {
    return Calibrate("left0?.jpg", "right0?.jpg", "--corners " + text + " --square-mm 30" + to);
  };
  const auto square = [&](const std::string& text) {
    return Calibrate("left*.jpg", "right*.jpg", "--corners 9x6 --square-mm " + text + to);
  };
  for (const auto& [command, message] : std::vector<std::pair<std::string, std::string>>{
           {Calibrate("left*.jpg", "right01.jpg", board), "13 left pictures, but 1 right"},
           {Calibrate("nothing*.jpg", "right*.jpg", board), "nothing*.jpg"},
           {Calibrate("no folder", "right*.jpg", board), "no folder: there is no such file"},
           {Calibrate("../../core", "right*.jpg", board), "no images in this folder"},
           {Calibrate("left*.jpg", "left*.jpg", board), "both a left and a right picture"},
           {corners("9by6"), "COLUMNSxROWS"},
           {corners("9x6x2"), "COLUMNSxROWS"},
           {corners("9x99999999999"), "'9x99999999999' is not"},
           {corners("9x2147483647"), "'9x2147483647' is not"},
           {corners("9x9"), "upside down"},
           {square("-30"), "'-30' is not a positive number"},
           {square("0"), "'0' is not a positive number"},
           {square("0.03"), "squares must have sides of 1 to 1000 mm, not of 0.03 mm"},
           {square("30000"), "squares must have sides of 1 to 1000 mm"},
           {square("inf"), "'inf' is not a positive number"},
           {square("thirty"), "--square-mm"},
           {Calibrate("left*.jpg", "right*.jpg", "--corners 9x6 --square-mm 30 --charuco" + to),
            "--marker-mm"}}) {
    ExpectRefused(command, message, out);
  }
}

TEST(CalibrateCommandTest, PicturesThatDoNotCalibrateAreRefusedAndLeaveNothing) {
  const TemporaryFolder folder;
  const auto out = folder / "rig";
  const std::string rest = " --square-mm 30 --out " + out.string();
  ExpectRefused(Calibrate("right0?.jpg", "left0?.jpg", "--corners 9x6" + rest), "swapped", out);
  ExpectRefused(Calibrate("left01.jpg", "right01.jpg", "--corners 9x6" + rest), "view", out);
  ExpectRefused(Calibrate("left0?.jpg", "right0?.jpg", "--corners 8x5" + rest), "8 x 5", out);
  ExpectRefused(
      Calibrate("left0?.jpg", "right0?.jpg", "--corners 9x6 --charuco --marker-mm 20" + rest),
      "markers", out);
}

TEST(CalibrateCommandTest, APictureThatIsMissingOnEachSideIsNoticed) {
  const TemporaryFolder folder;
  for (const char* side : {"left", "right"}) {
    std::filesystem::create_directory(folder / side);
    for (const char* number : {"01", "02", "03", "04", "05"}) {
      if (side == std::string("left") ? number == std::string("02") : number == std::string("04")) {
        continue;
      }
      const std::string name = fmt::format("{}{}.jpg", side, number);
      std::filesystem::copy(kPictures + name, folder / side / name);
    }
  }
  const std::string in = folder.path().string();
  ExpectRefused("calibrate stereo --left " + in + "/left --right " + in +
                    "/right --corners 9x6 --square-mm 30 --out " + in + "/rig",
                "left03.jpg would be paired with right02.jpg", folder / "rig");
}

TEST(CalibrateCommandTest, AFileInTheFoldersPlaceIsKept) {
  const TemporaryFolder folder;
  const auto file = folder.Write("rig", "mine");
  const ProgramOutput outcome = Fenestra(Calibrate(
      "left0?.jpg", "right0?.jpg", "--corners 9x6 --square-mm 30 --out " + file.string()));
  EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
  EXPECT_THAT(outcome.text, StartsWith(file.string()));
  EXPECT_EQ(ReadFile(file), "mine");
}

TEST(CalibrateCommandTest, ABracketIsPartOfAName) {
  const TemporaryFolder folder;
  for (const char* side : {"left", "right"}) {
    std::filesystem::create_directory(folder / (std::string("[") + side + "]"));
    for (const char* number : {"01", "03", "05", "07", "09", "12"}) {
      const std::string name = fmt::format("{}{}.jpg", side, number);
      std::filesystem::copy(kPictures + name, folder / fmt::format("[{}]", side) / name);
    }
  }
  // Given as a user in that folder would, with and without a '='.
  const std::string run = fmt::format(
      "cd {} && {} calibrate stereo --left '[left]' "
      "--right='[right]' --corners 9x6 --square-mm 30 --out '[rig]'",
      folder.path().string(), FENESTRA_PROGRAM);
  ASSERT_EQ(std::system((run + " > /dev/null").c_str()), 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "[rig]/stereo.yaml"));
}

}  // namespace
}  // namespace fenestra
