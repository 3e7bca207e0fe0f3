// Images that no sensor should deliver. Every detector that is registered says Miss or refuses
// them as input.

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/io/image_io.h"
#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

struct Hostile {
  std::string name;
  cv::Size image_size;        ///< Of what the detector gets.
  cv::Size calibration_size;  ///< Of what it was told.
  std::string gray;           ///< "black", "white", "noise"
  std::string depth;          ///< "none", "far", "noise"
};

cv::Mat Filled(cv::Size size, int type, const std::string& how) {
  const bool deep = CV_MAT_DEPTH(type) == CV_16U;
  const double most = deep ? 65535.0 : 255.0;
  cv::Mat image(size, type, cv::Scalar::all(how == "white" || how == "far" ? most : 0.0));
  if (how == "noise") cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0.0, most + 1.0);
  return image;
}

CameraModel Camera(cv::Size size) {
  return CameraModel({.width_px = size.width,
                      .height_px = size.height,
                      .fx_px = 0.9 * size.width,
                      .fy_px = 0.9 * size.width,
                      .cx_px = 0.5 * (size.width - 1),
                      .cy_px = 0.5 * (size.height - 1),
                      .distortion = {}});
}

SensorCalibration CalibrationFor(SensorKind sensor, cv::Size size) {
  const CameraModel camera = Camera(size);
  if (sensor == SensorKind::kRgbd) return RgbdCalibration{camera, camera, Pose()};
  return StereoCalibration{camera, camera, Pose(Eigen::Matrix3d::Identity(), {-0.35, 0.0, 0.0})};
}

Observation ObservationOf(SensorKind sensor, const Hostile& hostile) {
  const cv::Size size = hostile.image_size;
  if (sensor == SensorKind::kStereo) {
    cv::Mat1b right = Filled(size, CV_8UC1, hostile.gray);
    cv::flip(right, right, 1);  // Other noise than the left image's.
    return StereoObservation{Filled(size, CV_8UC1, hostile.gray), right};
  }
  return RgbdObservation{Filled(size, CV_8UC3, hostile.gray),
                         {Filled(size, CV_16UC1, hostile.depth), 0.001}};
}

class HostileImagesTest : public ::testing::TestWithParam<Hostile> {};

TEST_P(HostileImagesTest, GiveAMissOrAnInputErrorInEveryDetector) {
  const Hostile& hostile = GetParam();
  for (const DetectorInfo& info : Detectors()) {
    try {
      const auto detector =
          MakeDetector(info.name, CalibrationFor(info.sensor, hostile.calibration_size), {});
      StageLog log([] { return 0.0; }, true);  // With pictures, which have faults of their own.
      const Detection detection = detector->Detect(ObservationOf(info.sensor, hostile), log);
      EXPECT_TRUE(std::holds_alternative<Miss>(detection)) << info.name << " sees a window";
      EXPECT_EQ(hostile.image_size, hostile.calibration_size) << info.name << " takes any size";
    } catch (const InputError& error) {
      EXPECT_STRNE(error.what(), "") << info.name;
    } catch (const std::exception& error) {
      ADD_FAILURE() << info.name << " throws " << error.what();
    }
  }
}

const cv::Size kVga(640, 480);

INSTANTIATE_TEST_SUITE_P(
    EachKind, HostileImagesTest,
    ::testing::Values(Hostile{"black", kVga, kVga, "black", "none"},
                      Hostile{"black_far", kVga, kVga, "black", "far"},
                      Hostile{"black_noise", kVga, kVga, "black", "noise"},
                      Hostile{"white", kVga, kVga, "white", "none"},
                      Hostile{"white_far", kVga, kVga, "white", "far"},
                      Hostile{"noise", kVga, kVga, "noise", "none"},
                      Hostile{"noise_noise", kVga, kVga, "noise", "noise"},
                      Hostile{"one_pixel", {1, 1}, {1, 1}, "black", "none"},
                      Hostile{"one_white_pixel", {1, 1}, {1, 1}, "white", "far"},
                      Hostile{"one_row", {640, 1}, {640, 1}, "noise", "noise"},
                      Hostile{"one_column", {1, 480}, {1, 480}, "noise", "noise"},
                      Hostile{"one_pixel_of_many", {1, 1}, kVga, "black", "none"},
                      Hostile{"no_pixel", {0, 0}, kVga, "black", "none"},
                      Hostile{"huge", {8192, 8192}, kVga, "black", "none"}),
    [](const auto& test) { return test.param.name; });

TEST(HostileImagesTest, OtherObservationsAreRefused) {
  for (const DetectorInfo& info : Detectors()) {
    const auto detector = MakeDetector(info.name, CalibrationFor(info.sensor, kVga), {});
    const SensorKind other =
        info.sensor == SensorKind::kStereo ? SensorKind::kRgbd : SensorKind::kStereo;
    const Hostile black{"", kVga, kVga, "black", "none"};
    StageLog log([] { return 0.0; });
    EXPECT_THROW(detector->Detect(ObservationOf(other, black), log), InputError) << info.name;
  }
}

TEST(HostileImagesTest, FilesOfOtherChannelsOrDepthsAreRefusedAtReading) {
  const testing::TemporaryFolder folder;
  const auto write = [&folder](const char* name, int type, double value) {
    cv::imwrite((folder / name).string(), cv::Mat(4, 4, type, cv::Scalar::all(value)));
    return folder / name;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ReadDepthImage(write("nan.tiff", CV_32FC1, nan)), InputError);
  EXPECT_THROW(ReadDepthImage(write("float.tiff", CV_32FC1, 1.5)), InputError);
  EXPECT_THROW(ReadDepthImage(write("double.tiff", CV_64FC1, 1.5)), InputError);
  EXPECT_THROW(ReadDepthImage(write("deep8.png", CV_8UC1, 7)), InputError);
  EXPECT_THROW(ReadDepthImage(write("deep3.png", CV_16UC3, 7)), InputError);
  EXPECT_THROW(ReadGrayImage(write("color.png", CV_8UC3, 7)), InputError);
  EXPECT_THROW(ReadGrayImage(write("alpha.png", CV_8UC4, 7)), InputError);
  EXPECT_THROW(ReadGrayImage(write("gray16.png", CV_16UC1, 7)), InputError);
  EXPECT_THROW(ReadColorImage(write("color16.png", CV_16UC3, 7)), InputError);
  EXPECT_THROW(ReadColorImage(write("float3.tiff", CV_32FC3, nan)), InputError);
  EXPECT_NO_THROW(ReadDepthImage(write("depth.png", CV_16UC1, 7)));
  EXPECT_NO_THROW(ReadColorImage(write("alpha_is_dropped.png", CV_8UC4, 7)));
}

}  // namespace
}  // namespace fenestra
