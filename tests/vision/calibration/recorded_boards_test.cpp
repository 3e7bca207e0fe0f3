// Pictures of a real rig, with the calibration that J.-Y. Bouguet published for them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "core/io/image_io.h"
#include "vision/calibration/stereo_calibration.h"

namespace fenestra {
namespace {

const CalibrationBoard kBoard{.square_m = 0.03};
const cv::Size kSize(640, 480);

std::vector<BoardCorner> CornersIn(const char* side, int number) {
  const cv::Mat1b picture = ReadGrayImage(fmt::format(
      "{}/tests/data/stereo-calibration/{}{:02}.jpg", FENESTRA_SOURCE_DIR, side, number));
  const BoardSighting sighting = FindBoard(picture, kBoard);
  const auto* corners = std::get_if<std::vector<BoardCorner>>(&sighting);
  return corners != nullptr ? *corners : std::vector<BoardCorner>();
}

const std::vector<NamedView>& Views() {
  static const std::vector<NamedView> views = [] {
    std::vector<NamedView> all;
    for (const int number : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14}) {
      all.push_back({.name = fmt::format("view {}", number),
                     .corners = {CornersIn("left", number), CornersIn("right", number)}});
    }
    return all;
  }();
  return views;
}

// What OpenCV's sample stereo_calib.cpp gives for the same corners: its flags and criteria.
double RmsOfOpenCvSample() {
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> left;
  std::vector<std::vector<cv::Point2f>> right;
  for (const NamedView& view : Views()) {
    on_board.emplace_back();
    left.emplace_back();
    right.emplace_back();
    for (size_t i = 0; i < view.corners.left.size(); ++i) {
      const Eigen::Vector3f p = kBoard.Corner(view.corners.left[i].id).cast<float>();
      const Eigen::Vector2f l = view.corners.left[i].pixel.cast<float>();
      const Eigen::Vector2f r = view.corners.right[i].pixel.cast<float>();
      on_board.back().emplace_back(p.x(), p.y(), 0.0f);
      left.back().emplace_back(l.x(), l.y());
      right.back().emplace_back(r.x(), r.y());
    }
  }
  cv::Mat K1 = cv::initCameraMatrix2D(on_board, left, kSize, 0);
  cv::Mat K2 = cv::initCameraMatrix2D(on_board, right, kSize, 0);
  cv::Mat D1, D2, R, T, E, F;
  return cv::stereoCalibrate(
      on_board, left, right, K1, D1, K2, D2, kSize, R, T, E, F,
      cv::CALIB_FIX_ASPECT_RATIO + cv::CALIB_ZERO_TANGENT_DIST + cv::CALIB_USE_INTRINSIC_GUESS +
          cv::CALIB_SAME_FOCAL_LENGTH + cv::CALIB_RATIONAL_MODEL + cv::CALIB_FIX_K3 +
          cv::CALIB_FIX_K4 + cv::CALIB_FIX_K5,
      cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-5));
}

TEST(RecordedBoardsTest, AllCornersOfAllPicturesAreFound) {
  for (const NamedView& view : Views()) {
    EXPECT_EQ(view.corners.left.size(), 54u) << view.name;
    EXPECT_EQ(view.corners.right.size(), 54u) << view.name;
  }
}

TEST(RecordedBoardsTest, ResidualsAreNoLargerThanOpenCvs) {
  const StereoCalibrationResult result =
      CalibrateStereo(Views(), kBoard, {.left_size = kSize, .right_size = kSize});
  EXPECT_TRUE(result.left_out.empty());
  EXPECT_LE(result.rms_px, RmsOfOpenCvSample());
  EXPECT_LT(result.rms_px, 0.2);
}

TEST(RecordedBoardsTest, TheRigIsThePublishedOne) {
  // Bouguet's toolbox, example 5: its uncertainties (three standard deviations there) and ours.
  const StereoCalibrationResult result =
      CalibrateStereo(Views(), kBoard, {.left_size = kSize, .right_size = kSize});
  const CameraParameters& left = result.calibration.left.parameters();
  const CameraParameters& right = result.calibration.right.parameters();
  EXPECT_NEAR(left.fx_px, 533.00, 1.5);
  EXPECT_NEAR(left.fy_px, 533.15, 1.5);
  EXPECT_NEAR(left.cx_px, 341.59, 1.5);
  EXPECT_NEAR(left.cy_px, 234.26, 1.5);
  EXPECT_NEAR(right.fx_px, 536.98, 1.5);
  EXPECT_NEAR(right.fy_px, 536.57, 1.5);
  const Eigen::Vector3d p_RL = result.calibration.X_RL.translation();
  EXPECT_NEAR(p_RL.x(), -99.80e-3, 0.15e-3);
  EXPECT_NEAR(p_RL.y(), 1.12e-3, 0.15e-3);
  EXPECT_NEAR(p_RL.z(), 0.05e-3, 0.60e-3);
}

}  // namespace
}  // namespace fenestra
