#include "vision/plugin_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;

std::string Plugin(const std::string& fault) {
  return std::string(FENESTRA_TEST_PLUGINS) + "/libplugin_" + fault + ".so";
}

std::string Complaint(const std::string& library) {
  const size_t before = Detectors().size();
  try {
    LoadPlugin(library);
  } catch (const InputError& error) {
    EXPECT_EQ(Detectors().size(), before) << library;
    EXPECT_THAT(error.what(), HasSubstr(library));
    return error.what();
  }
  return "";
}

TEST(PluginLoaderTest, WhatCannotBeUsedIsRefusedAndSaysWhy) {
  const testing::TemporaryFolder folder;
  EXPECT_THAT(Complaint("/no/such/lib.so"), HasSubstr("no such file"));
  EXPECT_THAT(Complaint(folder.path().string()), HasSubstr("no such file"));
  EXPECT_THAT(Complaint(folder.Write("text.so", "text").string()), HasSubstr("cannot be loaded"));
  EXPECT_THAT(Complaint(Plugin("without_symbols")), HasSubstr("FENESTRA_DETECTOR_PLUGIN"));
  EXPECT_THAT(Complaint(Plugin("another_build")), HasSubstr("compiler 1.2.3"));
  EXPECT_THAT(Complaint(Plugin("throws")), HasSubstr("no licence"));
  EXPECT_THAT(Complaint(Plugin("registers_nothing")), HasSubstr("registers no detector"));
  EXPECT_THAT(Complaint(Plugin("taken_name")), HasSubstr("'paper-stereo'"));
  EXPECT_THAT(Complaint(Plugin("no_name")), HasSubstr("'My Detector'"));
}

TEST(PluginLoaderTest, ALoadedDetectorIsOneOfAll) {
  ASSERT_EQ(FindDetector("test-detector"), nullptr);
  EXPECT_EQ(LoadPlugin(Plugin("none")), 1);
  const DetectorInfo* info = FindDetector("test-detector");
  ASSERT_NE(info, nullptr);
  EXPECT_TRUE(info->isolate);
  EXPECT_EQ(info->options.size(), 2u);
  const CameraModel camera({.width_px = 8,
                            .height_px = 8,
                            .fx_px = 8.0,
                            .fy_px = 8.0,
                            .cx_px = 3.5,
                            .cy_px = 3.5,
                            .distortion = {}});
  const StereoCalibration calibration{camera, camera,
                                      Pose(Eigen::Matrix3d::Identity(), {-0.35, 0.0, 0.0})};
  StageLog log([] { return 0.0; });
  const StereoObservation observation{cv::Mat1b(8, 8, uchar{0}), cv::Mat1b(8, 8, uchar{0})};
  const auto detector = MakeDetector("test-detector", calibration, {{"depth_m", 2.5}});
  EXPECT_EQ(std::get<WindowEstimate>(detector->Detect(observation, log)).p_CO.z(), 2.5);
  // An exception's type is the same on both sides.
  EXPECT_THROW(
      MakeDetector("test-detector", calibration, {{"mode", "throw"}})->Detect(observation, log),
      std::runtime_error);
  EXPECT_THAT(Complaint(Plugin("none")), HasSubstr("already"));
}

TEST(PluginLoaderTest, AProgramRegistersDetectorsOfItsOwn) {
  const DetectorInfo info{
      .name = "of-this-test", .sensor = SensorKind::kRgbd, .description = "", .options = {}};
  const DetectorFactory none = [](const SensorCalibration&, const OptionValues&) {
    return std::unique_ptr<Detector>();
  };
  RegisterDetector(info, none);
  EXPECT_NE(FindDetector("of-this-test"), nullptr);
  EXPECT_THROW(RegisterDetector(info, none), InputError);
}

}  // namespace
}  // namespace fenestra
