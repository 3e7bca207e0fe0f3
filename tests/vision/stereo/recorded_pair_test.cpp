// A pair that no simulator made; see tests/data/README.md.

#include <gtest/gtest.h>

#include "core/image_io.h"
#include "vision/stereo/paper_stereo.h"

namespace fenestra {
namespace {

TEST(RecordedPairTest, AChessboardIsNoWindow) {
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
  PaperStereoOptions options;
  options.nearest_m = 0.3;  // The board is held half a metre away.
  options.farthest_m = 2.0;
  const PaperStereoDetector detector({left, right, Pose::Translation({-0.0998, 0.0, 0.0})},
                                     options);
  StageLog log([] { return 0.0; });
  const Detection detection =
      detector.Detect(StereoObservation{ReadGrayImage(folder / "left01.jpg"),
                                        ReadGrayImage(folder / "right01.jpg")},
                      log);
  EXPECT_TRUE(std::holds_alternative<Miss>(detection));
}

}  // namespace
}  // namespace fenestra
