// Frames that no simulator made; see tests/data/README.md.

#include <gtest/gtest.h>

#include "core/io/image_io.h"
#include "vision/rgbd/paper/paper_rgbd.h"
#include "vision/rgbd/plane/plane_rgbd.h"

namespace fenestra {
namespace {

struct Recording {
  std::string color;
  std::string depth;
  CameraParameters camera;
  double depth_unit_m;
};

CameraParameters Camera(double fx_px, double fy_px, double cx_px, double cy_px) {
  return {.width_px = 640,
          .height_px = 480,
          .fx_px = fx_px,
          .fy_px = fy_px,
          .cx_px = cx_px,
          .cy_px = cy_px,
          .distortion = {}};
}

const Recording kDesk{.color = "rgbd-tum/color.png",
                      .depth = "rgbd-tum/depth.png",
                      .camera = Camera(520.9, 521.0, 325.1, 249.7),
                      .depth_unit_m = 1.0 / 5000.0};
const Recording kLivingRoom{.color = "rgbd-icl-nuim/color.png",
                            .depth = "rgbd-icl-nuim/depth.png",
                            .camera = Camera(481.2, 480.0, 319.5, 239.5),
                            .depth_unit_m = 1.0 / 5000.0};
const Recording kCorner{.color = "rgbd-icl-nuim/4-color.png",
                        .depth = "rgbd-icl-nuim/4-depth.png",
                        .camera = kLivingRoom.camera,
                        .depth_unit_m = 1.0 / 5000.0};
const Recording kPlant{.color = "rgbd-icl-nuim/5-color.png",
                       .depth = "rgbd-icl-nuim/5-depth.png",
                       .camera = kLivingRoom.camera,
                       .depth_unit_m = 1.0 / 5000.0};
const Recording kCarpet{.color = "kinect-pcl/color.tiff",
                        .depth = "kinect-pcl/depth.tiff",
                        .camera = Camera(525.0, 525.0, 319.5, 239.5),
                        .depth_unit_m = 0.001};

template <typename DetectorType = PaperRgbdDetector, typename Options = PaperRgbdOptions>
Detection DetectIn(const Recording& recording, const Options& options) {
  const auto folder = std::filesystem::path(FENESTRA_SOURCE_DIR) / "tests/data";
  const CameraModel camera(recording.camera);
  const DetectorType detector({camera, camera, Pose(), recording.depth_unit_m}, options);
  StageLog log([] { return 0.0; });
  return detector.Detect(
      RgbdObservation{ReadColorImage(folder / recording.color),
                      {ReadDepthImage(folder / recording.depth), recording.depth_unit_m}},
      log);
}

Detection DetectOnDesk(const PaperRgbdOptions& options) {
  return DetectIn(kDesk, options);
}

// A frame whose sides are seen and whose middle is not.
PaperRgbdOptions OpenFrames() {
  PaperRgbdOptions options;
  options.min_seen_share = 0.5;
  options.max_filled_share = 0.5;
  return options;
}

TEST(RecordedFrameTest, AmongManyDarkThingsThereIsNoWindow) {
  const Detection detection = DetectOnDesk({});
  ASSERT_TRUE(std::holds_alternative<Miss>(detection));
  EXPECT_EQ(std::get<Miss>(detection).reason, "implausible_shape");
}

TEST(RecordedFrameTest, TheLargestDarkThingIsTheMonitor) {
  PaperRgbdOptions options;
  options.cloud = "largest_component";
  const Detection detection = DetectOnDesk(options);
  ASSERT_TRUE(std::holds_alternative<WindowEstimate>(detection));
  const auto& estimate = std::get<WindowEstimate>(detection);
  // The middle of the black screen is at pixel (308, 162), as one reads off the image; the
  // detector's vertices are good to a few per cent of the side.
  EXPECT_NEAR(estimate.p_CO.x() / estimate.p_CO.z(), (308.0 - 325.1) / 520.9, 0.02);
  EXPECT_NEAR(estimate.p_CO.y() / estimate.p_CO.z(), (162.0 - 249.7) / 521.0, 0.02);
  EXPECT_NEAR(estimate.p_CO.z(), 1.53, 0.05);
}

TEST(RecordedFrameTest, APictureFrameThatTheImageCutsIsNoWindow) {
  for (const PaperRgbdOptions& options : {PaperRgbdOptions{}, OpenFrames()}) {
    EXPECT_TRUE(std::holds_alternative<Miss>(DetectIn(kLivingRoom, options)));
  }
}

TEST(RecordedFrameTest, BareWallsHaveNoWindow) {
  for (const Recording& recording : {kCorner, kPlant}) {
    for (const PaperRgbdOptions& options : {PaperRgbdOptions{}, OpenFrames()}) {
      EXPECT_TRUE(std::holds_alternative<Miss>(DetectIn(recording, options))) << recording.color;
    }
  }
}

TEST(RecordedFrameTest, ADarkCarpetIsAWindowToThePaperUnlessAFrameIsAskedFor) {
  EXPECT_TRUE(std::holds_alternative<WindowEstimate>(DetectIn(kCarpet, {})));
  PaperRgbdOptions options = OpenFrames();
  for (const char* cloud : {"all", "largest_component", "each_component"}) {
    options.cloud = cloud;
    EXPECT_TRUE(std::holds_alternative<Miss>(DetectIn(kCarpet, options))) << cloud;
  }
}

TEST(RecordedFrameTest, AScreenHasNoOpening) {
  PaperRgbdOptions options = OpenFrames();
  options.cloud = "each_component";
  EXPECT_TRUE(std::holds_alternative<Miss>(DetectOnDesk(options)));
}

PlaneRgbdOptions AnyDepth() {
  PlaneRgbdOptions options;
  options.depth_to_m = 0.0;  // Not the SDK's driver.
  return options;
}

// The dark quadrilaterals are the monitor's screen and a book. The plane around them is the floor's
// or the desk's: on it the screen would be no rectangle, and the book lies before it.
TEST(RecordedFrameTest, AMonitorAndABookBeforeARoomAreInNoWall) {
  const Detection detection = DetectIn<PlaneRgbdDetector>(kDesk, AnyDepth());
  ASSERT_TRUE(std::holds_alternative<Miss>(detection));
  EXPECT_EQ(std::get<Miss>(detection).reason, "stands_before");
}

TEST(RecordedFrameTest, NeitherACutPictureFrameNorACarpetIsAWindow) {
  for (const Recording& recording : {kLivingRoom, kCorner, kPlant, kCarpet}) {
    EXPECT_TRUE(std::holds_alternative<Miss>(DetectIn<PlaneRgbdDetector>(recording, AnyDepth())))
        << recording.color;
  }
}

}  // namespace
}  // namespace fenestra
