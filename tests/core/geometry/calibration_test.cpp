#include "core/geometry/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <opencv2/core.hpp>

#include "core/io/input_error.h"
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

// `data` of a matrix in a camera_info, row by row.
template <int rows, int columns>
Eigen::Matrix<double, rows, columns> MatrixIn(const YAML::Node& info, const char* name) {
  const YAML::Node node = info[name];
  EXPECT_EQ(node["rows"].as<int>(), rows);
  EXPECT_EQ(node["cols"].as<int>(), columns);
  EXPECT_EQ(node["data"].size(), static_cast<size_t>(rows * columns));
  Eigen::Matrix<double, rows, columns> m;
  for (int i = 0; i < rows * columns; ++i)
    m(i / columns, i % columns) = node["data"][i].as<double>();
  return m;
}

// The row that a point of the left camera gets in the rectified image.
double RectifiedRow(const YAML::Node& info, const Eigen::Vector3d& p_CQ) {
  const auto R = MatrixIn<3, 3>(info, "rectification_matrix");
  const auto P = MatrixIn<3, 4>(info, "projection_matrix");
  const Eigen::Vector3d image = P * (R * p_CQ).homogeneous();
  return image.y() / image.z();
}

TEST(CalibrationIoTest, RosRectificationIsReadAsItWasWritten) {
  // The rectified frames: x along the baseline, whatever way the left camera looks.
  const Pose X_RL(RotationFromVector({0.01 / 3.0, -0.02 / 7.0, 0.03 / 9.0}),
                  {-1.05 / 3.0, 0.01, 0.02});
  const double baseline_m = X_RL.translation().norm();
  Eigen::Matrix3d R_left;
  R_left.row(0) = X_RL.inverse().translation().normalized();
  R_left.row(1) = Eigen::Vector3d::UnitZ().cross(R_left.row(0).transpose()).normalized();
  R_left.row(2) = R_left.row(0).cross(R_left.row(1));
  const Eigen::Matrix3d R_right = R_left * X_RL.rotation().transpose();
  const double f_px = 2000.0 / 3.0;
  RosRectification left{.rotation = R_left, .projection = {}};
  left.projection << f_px, 0, 375.1, 0, 0, f_px, 239.7, 0, 0, 0, 1, 0;
  RosRectification right{.rotation = R_right, .projection = left.projection};
  right.projection(0, 3) = -f_px * baseline_m;

  const TemporaryFolder folder;
  const auto left_file = folder.Write("left.yaml", ToRosCameraInfo(Camera(1.0), "left", left));
  const auto right_file = folder.Write("right.yaml", ToRosCameraInfo(Camera(1.1), "right", right));
  EXPECT_EQ(ReadCameraInfo(left_file), Camera(1.0));
  EXPECT_EQ(ReadCameraInfo(right_file), Camera(1.1));
  const YAML::Node left_info = YAML::LoadFile(left_file.string());
  const YAML::Node right_info = YAML::LoadFile(right_file.string());
  EXPECT_EQ(right_info["camera_name"].as<std::string>(), "right");

  // To the bit, R's rows as rows: the inverse rotation would be a rotation, too.
  const auto R = MatrixIn<3, 3>(right_info, "rectification_matrix");
  EXPECT_EQ(R, R_right);
  EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);  // 9 roundings.
  EXPECT_GT(R.determinant(), 0.0);
  const auto P = MatrixIn<3, 4>(right_info, "projection_matrix");
  EXPECT_EQ(P, right.projection);
  EXPECT_EQ(P(0, 3), -P(0, 0) * baseline_m);
  EXPECT_EQ((MatrixIn<3, 4>(left_info, "projection_matrix")), left.projection);

  // Rows agree, and columns differ by f b / z: what the files are for.
  for (const Eigen::Vector3d& p_LQ : {Eigen::Vector3d(0.3, -0.2, 2.0), Eigen::Vector3d(-1, 1, 9)}) {
    EXPECT_NEAR(RectifiedRow(left_info, p_LQ), RectifiedRow(right_info, X_RL * p_LQ), 1e-10);
  }
}

TEST(CalibrationIoTest, ACameraOfItsOwnIsItsOwnRectification) {
  const YAML::Node info = YAML::Load(ToRosCameraInfo(Camera(1.0), "alone"));
  EXPECT_EQ((MatrixIn<3, 3>(info, "rectification_matrix")), Eigen::Matrix3d::Identity());
  const auto P = MatrixIn<3, 4>(info, "projection_matrix");
  EXPECT_EQ(P.leftCols<3>(), Camera(1.0).Matrix());
  EXPECT_EQ(P.col(3), Eigen::Vector3d::Zero());
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

TEST(CalibrationIoTest, AFileOfAnotherKindIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.Write("other.yaml", "image_width: 640\nimage_height: 480\n");
  EXPECT_THROW(ReadStereoCalibration(file), InputError);
  EXPECT_THROW(ReadRgbdCalibration(file), InputError);
  EXPECT_THROW(ReadCameraInfo(file), InputError);
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
