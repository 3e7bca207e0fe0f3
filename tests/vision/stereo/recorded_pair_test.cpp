// A pair that no simulator made; see tests/data/README.md.

#include <gtest/gtest.h>

#include "core/image_io.h"
#include "vision/stereo/paper_stereo.h"

namespace fenestra {
namespace {

// Of the chessboard pair of this number: what paper-stereo says.
Detection DetectInPair(const std::string& number, PaperStereoOptions options) {
  const std::filesystem::path folder =
      std::filesystem::path(FENESTRA_SOURCE_DIR) / "tests/data/stereo-calibration";
  // Bouguet's published calibration of this rig, example 5 of his toolbox, with the rotation left
  // out: it turns by half a degree.
  const CameraModel left({.width_px = 640,
                          .height_px = 480,
                          .fx_px = 533.004,
                          .fy_px = 533.153,
                          .cx_px = 341.586,
                          .cy_px = 234.259,
                          .distortion = {.k1 = -0.288, .k2 = 0.097}});
  const CameraModel right({.width_px = 640,
                           .height_px = 480,
                           .fx_px = 536.983,
                           .fy_px = 536.569,
                           .cx_px = 326.472,
                           .cy_px = 249.332,
                           .distortion = {.k1 = -0.289, .k2 = 0.107}});
  options.nearest_m = 0.3;  // The board is held half a metre away.
  options.farthest_m = 2.0;
  const PaperStereoDetector detector({left, right, Pose::Translation({-0.0998, 0.0, 0.0})},
                                     options);
  StageLog log([] { return 0.0; });
  return detector.Detect(StereoObservation{ReadGrayImage(folder / ("left" + number + ".jpg")),
                                           ReadGrayImage(folder / ("right" + number + ".jpg"))},
                         log);
}

TEST(RecordedPairTest, AChessboardIsNoDarkFrame) {
  // The paper's pipeline looks at depth alone; the grey value of the frame is what tells a board
  // that is held up from a window.
  PaperStereoOptions options;
  options.prior.expected_grey_ratio = 0.1;
  for (const char* number : {"01", "04", "09", "14"}) {
    EXPECT_TRUE(std::holds_alternative<Miss>(DetectInPair(number, options))) << number;
  }
}

}  // namespace
}  // namespace fenestra
