#include "core/calibration_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/input_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

// Numbers with no short decimal form.
CameraModel Camera(double scale) {
  return CameraModel({.width_px = 752,
                      .height_px = 480,
                      .fx_px = 2000.0 / 3.0 * scale,
                      .fy_px = 2001.0 / 3.0 * scale,
                      .cx_px = 375.5 + scale / 7.0,
                      .cy_px = 239.5 - scale / 9.0,
                      .distortion = {-0.1 / 3.0, 0.01 / 7.0, 1e-4 / 3.0, -1e-4 / 7.0, 1e-5 / 3.0}});
}

const Pose kPose(RotationFromVector({0.01 / 3.0, -0.02 / 7.0, 0.03 / 9.0}),
                 {-1.05 / 3.0, 0.1, 0.2});

TEST(CalibrationIoTest, StereoSurvivesTheWayThroughAFileToTheBit) {
  const TemporaryFolder folder;
  const StereoCalibration calibration{Camera(1.0), Camera(1.1), kPose};
  const auto file = folder.Write("stereo.yaml", ToOpenCvYaml(calibration));
  EXPECT_EQ(ReadStereoCalibration(file), calibration);
}

TEST(CalibrationIoTest, RgbdSurvivesTheWayThroughAFileToTheBit) {
  const TemporaryFolder folder;
  const RgbdCalibration calibration{Camera(1.0), Camera(0.5), kPose, 1.0 / 5000.0};
  const auto file = folder.Write("rgbd.yaml", ToOpenCvYaml(calibration));
  EXPECT_EQ(ReadRgbdCalibration(file), calibration);
}

TEST(CalibrationIoTest, OpenCvReadsWhatIsWritten) {
  const TemporaryFolder folder;
  const StereoCalibration calibration{Camera(1.0), Camera(1.1), kPose};
  const auto file = folder.Write("stereo.yaml", ToOpenCvYaml(calibration));
  const cv::FileStorage storage(file.string(), cv::FileStorage::READ);
  ASSERT_TRUE(storage.isOpened());
  cv::Mat K2;
  cv::Mat T;
  storage["K2"] >> K2;
  storage["T"] >> T;
  EXPECT_EQ(K2.at<double>(0, 0), calibration.right.parameters().fx_px);
  EXPECT_EQ(T.at<double>(0), calibration.X_RL.translation().x());
}

TEST(CalibrationIoTest, WhatOpenCvWritesIsRead) {
  const TemporaryFolder folder;
  const auto file = folder / "stereo.yaml";
  {
    cv::FileStorage storage(file.string(), cv::FileStorage::WRITE);
    const cv::Mat K = (cv::Mat_<double>(3, 3) << 533.004, 0, 341.586, 0, 533.153, 234.259, 0, 0, 1);
    const cv::Mat D = (cv::Mat_<double>(1, 5) << -0.28, 0.1, 0.001, -0.0002, 0.0);
    storage << "image_width" << 640 << "image_height" << 480;
    storage << "K1" << K << "D1" << D << "K2" << K << "D2" << D;
    storage << "R" << cv::Mat::eye(3, 3, CV_64F) << "T"
            << (cv::Mat_<double>(3, 1) << -0.0998, 0, 0);
    storage << "Q" << cv::Mat::eye(4, 4, CV_64F);  // Not ours: ignored.
  }
  const StereoCalibration calibration = ReadStereoCalibration(file);
  EXPECT_EQ(calibration.left.parameters().fx_px, 533.004);
  EXPECT_EQ(calibration.X_RL.translation().x(), -0.0998);
}

TEST(CalibrationIoTest, RosCameraInfoSurvives) {
  const TemporaryFolder folder;
  const auto file = folder.Write("left.yaml", ToRosCameraInfo(Camera(1.0), "left"));
  EXPECT_EQ(ReadCameraInfo(file), Camera(1.0));
}

TEST(CalibrationIoTest, AllFaultsAreReportedWithTheirPlace) {
  const TemporaryFolder folder;
  std::string text = ToOpenCvYaml(StereoCalibration{Camera(1.0), Camera(1.0), kPose});
  text.replace(text.find("image_width: 752"), 16, "image_width: -52");
  text.replace(text.find("K2:"), 3, "KZ:");
  try {
    ReadStereoCalibration(folder.Write("bad.yaml", text));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bad.yaml:3:14: image_width must be a whole number"));
    EXPECT_THAT(error.what(), HasSubstr("K2 is missing"));
  }
}

TEST(CalibrationIoTest, WhatIsNoRotationOrNoBaselineIsRefused) {
  const TemporaryFolder folder;
  const std::string text = ToOpenCvYaml(StereoCalibration{Camera(1.0), Camera(1.0), Pose()});
  EXPECT_THROW(ReadStereoCalibration(folder.Write("no_baseline.yaml", text)), InputError);
  std::string sheared = text;
  sheared.replace(sheared.find("data: [ 1, 0, 0, 0, 1"), 21, "data: [ 1, 1, 0, 0, 1");
  EXPECT_THROW(ReadStereoCalibration(folder.Write("sheared.yaml", sheared)), InputError);
}

}  // namespace
}  // namespace fenestra
