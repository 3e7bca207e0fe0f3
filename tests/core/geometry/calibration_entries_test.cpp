#include "core/geometry/calibration_entries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

const CameraModel kCamera = CameraModel::Pinhole(640, 480, 520.0);

std::string StereoText() {
  return ToOpenCvYaml(StereoCalibration{kCamera, kCamera, Pose::Translation({-0.35, 0.0, 0.0})});
}

std::string RgbdText() {
  return ToOpenCvYaml(
      RgbdCalibration{kCamera, kCamera, Pose::Translation({0.025, 0.0, 0.0}), 0.001});
}

std::string With(std::string text, const std::string& part, const std::string& other) {
  const size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), other);
}

// "" for a file that is read.
std::string Complaint(const std::string& text, SensorKind sensor) {
  const TemporaryFolder folder;
  const auto file = folder.Write("c.yaml", text);
  try {
    sensor == SensorKind::kStereo ? void(ReadStereoCalibration(file))
                                  : void(ReadRgbdCalibration(file));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string StereoComplaint(const std::string& text) {
  return Complaint(text, SensorKind::kStereo);
}

std::string RgbdComplaint(const std::string& text) {
  return Complaint(text, SensorKind::kRgbd);
}

TEST(CalibrationEntries, AnotherLensModelIsRefusedHoweverItIsStated) {
  for (const char* statement :
       {"distortion_model: equidistant", "distortion_model: Fisheye", "camera_model: omni",
        "lens_model: kannala_brandt", "distortion_model: inverse_brown_conrady",
        "distortion_models: [plumb_bob, equidistant]", "left_camera_model: ds", "fisheye: true",
        "fisheye: 1", "left: {distortion_model: equidistant}", "distortion_model: [equidistant]"}) {
    EXPECT_THAT(StereoComplaint(StereoText() + statement + "\n"), HasSubstr("another lens model"))
        << statement;
    EXPECT_THAT(RgbdComplaint(RgbdText() + statement + "\n"), HasSubstr("another lens model"))
        << statement;
  }
}

TEST(CalibrationEntries, TheModelThatIsReadMayBeStated) {
  for (const char* statement :
       {"distortion_model: plumb_bob", "distortion_model: Plumb Bob", "camera_model: pinhole",
        "distortion_model: radtan", "distortion_model: rational_polynomial", "fisheye: false",
        "fisheye: 0", "unit: m", "camera_model: ZED 2", "square_units: mm",
        "calibration_time: today", "camera_name: fisheye"}) {
    EXPECT_EQ(StereoComplaint(StereoText() + statement + "\n"), "") << statement;
  }
}

TEST(CalibrationEntries, CoefficientsOfARationalModelMustBeZero) {
  const std::string five = "rows: 1\n   cols: 5\n   dt: d\n   data: [ 0, 0, 0, 0, 0 ]";
  EXPECT_EQ(StereoComplaint(With(StereoText(), five, "data: [0.1, 0, 0, 0, 0, 0, 0, 0]")), "");
  EXPECT_THAT(StereoComplaint(With(StereoText(), five, "data: [0.1, 0, 0, 0, 0, 0.3, 0, 0]")),
              HasSubstr("D1 has 8 numbers, as of a rational"));
}

TEST(CalibrationEntries, LengthsInAnotherUnitAreRefused) {
  EXPECT_THAT(StereoComplaint(StereoText() + "unit: mm\n"), HasSubstr("read in metres"));
  EXPECT_THAT(StereoComplaint(StereoText() + "T_units: [cm, cm, cm]\n"),
              HasSubstr("read in metres"));
  // Without a statement the numbers themselves tell.
  EXPECT_THAT(StereoComplaint(With(StereoText(), "-0.35", "-350")), HasSubstr("millimetres"));
  EXPECT_THAT(StereoComplaint(With(StereoText(), "-0.35", "-12")), HasSubstr("12 m apart"));
  EXPECT_EQ(StereoComplaint(With(StereoText(), "-0.35", "-9")), "");
  EXPECT_THAT(RgbdComplaint(With(RgbdText(), "0.025", "25")), HasSubstr("millimetres"));
}

TEST(CalibrationEntries, FocalLengthsAreInPixels) {
  EXPECT_THAT(
      StereoComplaint(With(StereoText(), "520, 0, 319.5, 0, 520", "0.8125, 0, 0.5, 0, 1.08")),
      HasSubstr("field of view"));
  EXPECT_THAT(RgbdComplaint(With(RgbdText(), "520, 0, 319.5, 0, 520", "4, 0, 319.5, 0, 4")),
              HasSubstr("not in millimetres"));
  // Of a very wide lens.
  EXPECT_EQ(StereoComplaint(With(StereoText(), "520, 0, 319.5, 0, 520", "60, 0, 319.5, 0, 60")),
            "");
}

TEST(CalibrationEntries, ADepthUnitIsPlausibleAndCalledAsKnown) {
  for (const char* unit : {"1000", "0.1", "1e-9", "0", "-0.001"}) {
    EXPECT_THAT(RgbdComplaint(With(RgbdText(), "unit_m: 0.001", std::string("unit_m: ") + unit)),
                HasSubstr("a unit of depth must be"))
        << unit;
  }
  EXPECT_EQ(RgbdComplaint(With(RgbdText(), "unit_m: 0.001", "unit_m: 0.01")), "");
  for (const char* key : {"depth_units_m: 0.0002", "depth_scale: 5000", "DepthMapFactor: 5000.0",
                          "deph_unit_m: 0.0002", "depth_unit_mm: 0.2"}) {
    EXPECT_THAT(RgbdComplaint(With(RgbdText(), "depth_unit_m: 0.001", key)),
                HasSubstr("Did you mean 'depth_unit_m'?"))
        << key;
  }
  EXPECT_EQ(RgbdComplaint(With(RgbdText(), "depth_unit_m: 0.001", "depth_camera: front")), "");
}

TEST(CalibrationEntries, WhetherADepthUnitIsStatedCanBeAsked) {
  const TemporaryFolder folder;
  EXPECT_TRUE(StatesDepthUnit(folder.Write("with.yaml", RgbdText())));
  EXPECT_FALSE(
      StatesDepthUnit(folder.Write("without.yaml", With(RgbdText(), "depth_unit_m: 0.001\n", ""))));
}

TEST(CalibrationEntries, AnEntryThatStandsTwiceIsRefused) {
  EXPECT_THAT(StereoComplaint(StereoText() + "image_width: 752\n"), HasSubstr("stands twice"));
}

TEST(CalibrationEntries, MatricesMayBeListsOrRows) {
  const TemporaryFolder folder;
  const std::string text =
      "image_width: 640\nimage_height: 480\n"
      "K1: [520, 0, 319.5, 0, 520, 239.5, 0, 0, 1]\n"
      "K2: [[520, 0, 319.5], [0, 520, 239.5], [0, 0, 1]]\n"
      "D1: [0, 0, 0, 0]\nD2: [[0, 0, 0, 0, 0]]\n"
      "R: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n";
  const StereoCalibration expected{kCamera, kCamera, Pose::Translation({-0.35, 0.0, 0.0})};
  for (const char* T :
       {"T: [-0.35, 0, 0]\n", "T: [[-0.35], [0], [0]]\n", "T: {data: [-0.35, 0, 0]}\n"}) {
    EXPECT_EQ(ReadStereoCalibration(folder.Write("c.yaml", text + T)), expected) << T;
  }
  EXPECT_THAT(StereoComplaint(text + "T: [-0.35, 0]\n"),
              HasSubstr("T must be a list of 3 numbers"));
  EXPECT_THAT(StereoComplaint(text + "T: [[-0.35], [0]]\n"),
              HasSubstr("T must have 3 numbers, not 2"));
  EXPECT_THAT(StereoComplaint(text + "T: [[-0.35], 0, 0]\n"), HasSubstr("finite number"));
  EXPECT_THAT(StereoComplaint(text + "T: far\n"), HasSubstr("c.yaml:8:4: T must be a list"));
}

TEST(CalibrationEntries, FormatsOfOtherProgramsAreCalledByTheirNames) {
  EXPECT_THAT(StereoComplaint(ToRosCameraInfo(kCamera, "left")), HasSubstr("ROS"));
  EXPECT_THAT(RgbdComplaint(ToRosCameraInfo(kCamera, "color")), HasSubstr("ROS"));
  EXPECT_THAT(StereoComplaint("cam0:\n  camera_model: pinhole\n  intrinsics: [1, 2, 3, 4]\n"),
              HasSubstr("Kalibr"));
  EXPECT_THAT(StereoComplaint("<?xml version=\"1.0\"?>\n<opencv_storage>\n</opencv_storage>\n"),
              HasSubstr("XML; YAML and JSON are read"));
}

}  // namespace
}  // namespace fenestra
