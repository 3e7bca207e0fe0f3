// A frame that no simulator made; see tests/data/README.md.

#include <gtest/gtest.h>

#include "core/image_io.h"
#include "vision/rgbd/paper_rgbd.h"
#include "vision/rgbd/plane_rgbd.h"

namespace fenestra {
namespace {

const std::filesystem::path kFolder =
    std::filesystem::path(FENESTRA_SOURCE_DIR) / "tests/data/rgbd-tum";

template <typename DetectorType, typename Options>
Detection DetectOnDesk(const Options& options) {
  const CameraModel camera({.width_px = 640,
                            .height_px = 480,
                            .fx_px = 520.9,
                            .fy_px = 521.0,
                            .cx_px = 325.1,
                            .cy_px = 249.7,
                            .distortion = {}});
  const DetectorType detector({camera, camera, Pose(), 1.0 / 5000.0}, options);
  StageLog log([] { return 0.0; });
  return detector.Detect(RgbdObservation{ReadColorImage(kFolder / "color.png"),
                                         {ReadDepthImage(kFolder / "depth.png"), 1.0 / 5000.0}},
                         log);
}

TEST(RecordedFrameTest, AmongManyDarkThingsThereIsNoWindow) {
  const Detection detection = DetectOnDesk<PaperRgbdDetector>(PaperRgbdOptions{});
  ASSERT_TRUE(std::holds_alternative<Miss>(detection));
  EXPECT_EQ(std::get<Miss>(detection).reason, "implausible_shape");
}

TEST(RecordedFrameTest, TheLargestDarkThingIsTheMonitor) {
  PaperRgbdOptions options;
  options.cloud = "largest_component";
  const Detection detection = DetectOnDesk<PaperRgbdDetector>(options);
  ASSERT_TRUE(std::holds_alternative<WindowEstimate>(detection));
  const auto& estimate = std::get<WindowEstimate>(detection);
  // The middle of the black screen is at pixel (308, 162), as one reads off the image; the
  // detector's vertices are good to a few per cent of the side.
  EXPECT_NEAR(estimate.p_CO.x() / estimate.p_CO.z(), (308.0 - 325.1) / 520.9, 0.02);
  EXPECT_NEAR(estimate.p_CO.y() / estimate.p_CO.z(), (162.0 - 249.7) / 521.0, 0.02);
  EXPECT_NEAR(estimate.p_CO.z(), 1.53, 0.05);
}

// The only dark quadrilateral is the monitor's screen; but the plane around it is the floor's or
// the desk's, on which it would be no rectangle: it hangs in no wall.
TEST(RecordedFrameTest, AMonitorBeforeARoomHangsInNoWall) {
  PlaneRgbdOptions options;
  options.depth_to_m = 0.0;  // Not the SDK's driver.
  const Detection detection = DetectOnDesk<PlaneRgbdDetector>(options);
  ASSERT_TRUE(std::holds_alternative<Miss>(detection));
  EXPECT_EQ(std::get<Miss>(detection).reason, "not_a_rectangle");
}

}  // namespace
}  // namespace fenestra
