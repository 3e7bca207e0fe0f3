#include "experiments/rig_calibration/calibration_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <yaml-cpp/yaml.h>
#include <cmath>
#include <sstream>

#include "core/geometry/calibration.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReadFile;
using testing::TemporaryFolder;

CameraModel Camera(double f_px) {
  return CameraModel({.width_px = 752,
                      .height_px = 480,
                      .fx_px = f_px,
                      .fy_px = f_px + 1.0,
                      .cx_px = 372.25,
                      .cy_px = 243.5,
                      .distortion = {.k1 = -0.11, .k2 = 0.02}});
}

// A covariance of deviations 0.04, 0.08, 0.12 …, neighbours correlated by ±0.5; k3 fixed.
PairMatrix Covariance() {
  PairMatrix covariance = PairMatrix::Zero();
  const auto deviation = [](int i) { return 0.04 * (i + 1); };
  for (int i = 0; i < kPairParameters; ++i) {
    if (i % kCameraParameters == 8 && i < 2 * kCameraParameters) continue;
    covariance(i, i) = deviation(i) * deviation(i);
  }
  covariance(0, 1) = covariance(1, 0) = 0.9 * deviation(0) * deviation(1);
  covariance(2, 3) = covariance(3, 2) = -0.95 * deviation(2) * deviation(3);
  return covariance;
}

StereoCalibrationResult Result() {
  StereoCalibrationResult result{
      .calibration = {.left = Camera(664.123),
                      .right = Camera(671.0),
                      .X_RL = Pose(RotationFromVector({2e-3, -5e-3, 3e-3}), {-0.351, 1e-3, -5e-4})},
      .covariance = Covariance(),
      .corner_deviation_px = 0.0512,
      .rms_px = 0.0611,
      .camera_rms_px = {0.0604, 0.0618},
      .views = {{"03.png", 0.05, 0.06}, {"11.png", 0.07, 0.08}},
      .residuals = {},
      .left_out = {{"07.png", "only 3 corners in the left picture"}}};
  for (auto& camera : result.residuals) {
    camera = {{{100.0, 120.0}, {0.05, -0.02}}, {{400.0, 300.0}, {-0.04, 0.06}}};
  }
  return result;
}

// The line that begins with the parameter's name.
std::string LineOf(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(name + " ") || line.starts_with("| " + name + " ")) return line;
  }
  return "";
}

TEST(CalibrationReport, ParametersHaveTheDecimalsThatTheirDeviationAllows) {
  const std::string text = CalibrationReport(Result(), {}, ReportFormat::kPlain);
  EXPECT_THAT(LineOf(text, "fx [px]"), HasSubstr("664.123 ± 0.040"));
  EXPECT_THAT(LineOf(text, "fx [px]"), HasSubstr("671.00 ± 0.40"));
  EXPECT_THAT(LineOf(text, "k3"), HasSubstr("0 (fixed)"));
}

TEST(CalibrationReport, SaysHowTheCamerasStandToEachOther) {
  const std::string text = CalibrationReport(Result(), {}, ReportFormat::kPlain);
  EXPECT_THAT(text, HasSubstr("baseline 351.00 mm"));  // √(351² + 1² + 0.5²) = 351.0018
  // Milliradians and millimetres, each with its own deviation.
  EXPECT_THAT(LineOf(text, "x (right)"), HasSubstr("2 ± 760"));
  EXPECT_THAT(LineOf(text, "x (right)"), HasSubstr("-351 ± 880"));
}

TEST(CalibrationReport, NamesViewsAndThoseThatWereLeftOut) {
  const std::string text = CalibrationReport(Result(), {}, ReportFormat::kPlain);
  EXPECT_THAT(text, HasSubstr("2 views of a board of 9 x 6 inner corners, squares of 60 mm"));
  EXPECT_THAT(LineOf(text, "11.png"), HasSubstr("0.070"));
  EXPECT_THAT(text, HasSubstr("07.png: only 3 corners in the left picture"));
  StereoCalibrationResult all_used = Result();
  all_used.left_out.clear();
  EXPECT_THAT(CalibrationReport(all_used, {}, ReportFormat::kPlain), Not(HasSubstr("Left out")));
}

TEST(CalibrationReport, ThePairsThatAreToldApartWorstComeFirst) {
  const std::string text = CalibrationReport(Result(), {}, ReportFormat::kMarkdown);
  const size_t worst = text.find("-0.950");
  const size_t second = text.find("+0.900");
  ASSERT_NE(worst, std::string::npos);
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(worst, second);
}

TEST(CalibrationReport, TheCovarianceHasARowAndAColumnForEachParameter) {
  std::istringstream lines(CovarianceCsv(Result()));
  std::string line;
  std::getline(lines, line);
  const auto fields = [](const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
  };
  const std::vector<std::string> header = fields(line);
  ASSERT_EQ(header.size(), 1u + kPairParameters);
  int row = 0;
  for (; std::getline(lines, line); ++row) {
    const std::vector<std::string> entries = fields(line);
    ASSERT_EQ(entries.size(), header.size());
    EXPECT_EQ(entries[0], header[static_cast<size_t>(row) + 1]);
    for (int column = 0; column < kPairParameters; ++column) {
      EXPECT_EQ(std::stod(entries[static_cast<size_t>(column) + 1]), Covariance()(row, column));
    }
  }
  EXPECT_EQ(row, kPairParameters);
}

TEST(CalibrationReport, WhatIsWrittenReadsBackAndRectifies) {
  const TemporaryFolder folder;
  const StereoCalibrationResult result = Result();
  WriteCalibration(folder.path(), result, {});
  const StereoCalibration pair = ReadStereoCalibration(folder / "stereo.yaml");
  EXPECT_EQ(pair.left.parameters(), result.calibration.left.parameters());
  EXPECT_EQ(pair.X_RL.translation(), result.calibration.X_RL.translation());
  for (const char* name : {"report.md", "covariance.csv", "residuals.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  // After rectification the rows of both cameras are the same and the baseline is along x:
  // P = K [I | t], with t = (-f b, 0, 0) for the right camera.
  const YAML::Node left = YAML::Load(ReadFile(folder / "left.yaml"));
  const YAML::Node right = YAML::Load(ReadFile(folder / "right.yaml"));
  const auto projection = [](const YAML::Node& camera, size_t i) {
    return camera["projection_matrix"]["data"][i].as<double>();
  };
  EXPECT_EQ(projection(left, 0), projection(right, 0));
  EXPECT_EQ(projection(left, 6), projection(right, 6));
  const double baseline_m = result.calibration.X_RL.translation().norm();
  EXPECT_NEAR(-projection(right, 3) / projection(right, 0), baseline_m, 1e-9);
  EXPECT_NEAR(projection(right, 7), 0.0, 1e-9);
}

}  // namespace
}  // namespace fenestra
