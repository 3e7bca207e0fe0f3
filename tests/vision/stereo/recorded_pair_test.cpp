// Pairs that no simulator made; see tests/data/README.md.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/image_io.h"
#include "vision/stereo/edge/edge_stereo.h"
#include "vision/stereo/paper/paper_stereo.h"

namespace fenestra {
namespace {

constexpr const char* kPairs[] = {"01", "02", "03", "04", "05", "06", "07",
                                  "08", "09", "11", "12", "13", "14"};

// Bouguet's published calibration of this rig, example 5 of his toolbox.
StereoCalibration Rig() {
  const CameraModel left(
      {.width_px = 640,
       .height_px = 480,
       .fx_px = 533.004,
       .fy_px = 533.153,
       .cx_px = 341.586,
       .cy_px = 234.259,
       .distortion = {.k1 = -0.28838, .k2 = 0.09714, .p1 = 0.00109, .p2 = -0.0003}});
  const CameraModel right(
      {.width_px = 640,
       .height_px = 480,
       .fx_px = 536.983,
       .fy_px = 536.569,
       .cx_px = 326.472,
       .cy_px = 249.332,
       .distortion = {.k1 = -0.28936, .k2 = 0.10677, .p1 = -0.00078, .p2 = 0.0002}});
  return {left, right,
          Pose(RotationFromVector({0.00669, 0.00452, -0.0035}), {-0.0998, 0.00112, 0.00005})};
}

Detection DetectInPair(const Detector& detector, const std::string& number) {
  const std::filesystem::path folder =
      std::filesystem::path(FENESTRA_SOURCE_DIR) / "tests/data/stereo-calibration";
  StageLog log([] { return 0.0; });
  return detector.Detect(StereoObservation{ReadGrayImage(folder / ("left" + number + ".jpg")),
                                           ReadGrayImage(folder / ("right" + number + ".jpg"))},
                         log);
}

std::vector<std::string> PairsWithAWindow(const Detector& detector) {
  std::vector<std::string> pairs;
  for (const char* number : kPairs) {
    if (std::holds_alternative<WindowEstimate>(DetectInPair(detector, number))) {
      pairs.push_back(number);
    }
  }
  return pairs;
}

TEST(RecordedPairTest, AChessboardIsNoDarkFrame) {
  PaperStereoOptions options;
  options.prior.expected_grey_ratio = 0.1;
  EXPECT_THAT(PairsWithAWindow(PaperStereoDetector(Rig(), options)), ::testing::IsEmpty());
  options.nearest_m = 0.3;  // The board is held half a metre away.
  options.farthest_m = 2.0;
  EXPECT_THAT(PairsWithAWindow(PaperStereoDetector(Rig(), options)), ::testing::IsEmpty());
}

TEST(RecordedPairTest, DepthAloneTakesAPatternThatRepeatsForAFrame) {
  // The paper's pipeline looks at depth alone: in pair 06 columns of squares are matched with their
  // neighbours, and two of those bands make a plane 7 m away.
  EXPECT_THAT(PairsWithAWindow(PaperStereoDetector(Rig(), {})), ::testing::ElementsAre("06"));
}

TEST(RecordedPairTest, EdgeStereoSeesNoFrameInAChessboard) {
  EXPECT_THAT(PairsWithAWindow(EdgeStereoDetector(Rig(), {})), ::testing::IsEmpty());
  EdgeStereoOptions near;
  near.search.limits.nearest_m = 0.3;
  near.search.limits.farthest_m = 2.0;
  EXPECT_THAT(PairsWithAWindow(EdgeStereoDetector(Rig(), near)), ::testing::IsEmpty());
}

}  // namespace
}  // namespace fenestra
