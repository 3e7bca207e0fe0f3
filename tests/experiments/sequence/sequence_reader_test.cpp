#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/calibration.h"
#include "core/io/input_error.h"
#include "experiments/sequence/sequence.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

constexpr const char* kWindow =
    "{centroid_m: [-0.05, -0.258, 1.53], width_m: 0.39, height_m: 0.29}";

/// A folder with a calibration and the two images of one frame, which are not looked at.
class SequenceReaderTest : public ::testing::Test {
 protected:
  SequenceReaderTest() {
    const CameraModel camera = CameraModel::Pinhole(640, 480, 520.0);
    folder_.Write("rgbd.yaml", ToOpenCvYaml(RgbdCalibration{camera, camera, Pose(), 1.0 / 5000.0}));
    folder_.Write("color.png", "");
    folder_.Write("depth.png", "");
  }

  std::string Text(const std::string& truth) const {
    return "name: desk\nsensor: rgbd\ncalibration: rgbd.yaml\ndetectors:\n  - {name: paper-rgbd, "
           "options: {cloud: largest_component}}\nframes:\n  - {color: color.png, depth: "
           "depth.png, truth: " +
           truth + "}\n";
  }

  std::string Complaint(const std::string& text) const {
    try {
      ReadSequence(folder_.Write("sequence.yaml", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(SequenceReaderTest, AFrameHasItsImagesItsTruthAndItsLevels) {
  const std::string truth = std::string(kWindow) + ", levels: {light: dusk}";
  const Sequence sequence = ReadSequence(folder_.Write("sequence.yaml", Text(truth)));
  EXPECT_EQ(sequence.name, "desk");
  EXPECT_EQ(sequence.sensor, SensorKind::kRgbd);
  ASSERT_EQ(sequence.detectors.size(), 1u);
  EXPECT_EQ(sequence.detectors[0].name, "paper-rgbd");
  ASSERT_EQ(sequence.frames.size(), 1u);
  EXPECT_EQ(sequence.frames[0].files.color, folder_ / "color.png");
  EXPECT_EQ(sequence.frames[0].files.calibration, folder_ / "rgbd.yaml");
}

TEST_F(SequenceReaderTest, FaultsAreReportedWithTheirPlace) {
  EXPECT_EQ(Complaint(Text("none")), "");
  EXPECT_EQ(Complaint(Text("{other_windows: [" + std::string(kWindow) + "]}")), "");
  EXPECT_THAT(Complaint(Text("there")), HasSubstr("sequence.yaml:7:"));
  EXPECT_THAT(Complaint(Text("{centroid_m: [0, 1], width_m: 1, height_m: 1}")),
              HasSubstr("list of 3 numbers"));
  EXPECT_THAT(Complaint(Text("{centroid_m: [0, 0, .nan], width_m: 1, height_m: 1}")),
              HasSubstr("finite number"));
  EXPECT_THAT(Complaint(Text("{centroid_m: [0, 0, 1], width_m: 0, height_m: 1}")),
              HasSubstr("width_m must be above 0"));
  EXPECT_THAT(Complaint(Text("{centroid_m: [0, 0, 1], width_m: 1}")), HasSubstr("height_m"));
  EXPECT_THAT(Complaint(Text("{centriod_m: [0, 0, 1], width_m: 1, height_m: 1}")),
              HasSubstr("Did you mean 'centroid_m'?"));
  EXPECT_THAT(Complaint(Text("none, levels: {light: dusk, light: noon}")),
              HasSubstr("'light' stands twice in levels"));
  EXPECT_THAT(Complaint("name: a\nsensor: rgbd\nframes: []\n"), HasSubstr("at least one frame"));
  EXPECT_THAT(Complaint("name: a\nsensor: rgbd\n"), HasSubstr("needs frames"));
  EXPECT_THAT(Complaint("name: a\n"), HasSubstr("needs sensor"));
  EXPECT_THAT(Complaint("[1]\n"), HasSubstr("sequence.yaml:1:1"));
  const std::string missing =
      Complaint("name: a\nsensor: stereo\nframes:\n  - {left: l.png, right: r.png, truth: none}\n");
  EXPECT_THAT(missing, HasSubstr("sequence.yaml:4:12: there is no file"));
  EXPECT_THAT(missing, HasSubstr("sequence.yaml:4:26: there is no file"));  // Both at once.
  EXPECT_THAT(missing, HasSubstr("needs calibration"));
}

TEST_F(SequenceReaderTest, ATruthIsAheadOfTheCameraAndInMetres) {
  const auto truth = [](const std::string& z, const std::string& width, const std::string& more) {
    return "{centroid_m: [0, 0, " + z + "], width_m: " + width + ", height_m: 1" + more + "}";
  };
  EXPECT_THAT(Complaint(Text(truth("-2", "1", ""))), HasSubstr("behind the camera"));
  EXPECT_THAT(Complaint(Text(truth("0", "1", ", in_view: true"))), HasSubstr("behind the camera"));
  EXPECT_THAT(Complaint(Text(truth("2", "1000", ""))),
              HasSubstr("width_m must be above 0 and at most 100"));
  EXPECT_THAT(Complaint(Text("{other_windows: [" + truth("2", "900", "") + "]}")),
              HasSubstr("width_m"));
  // What is not in view may be behind the camera.
  EXPECT_EQ(Complaint(Text(truth("-2", "1", ", in_view: false"))), "");
  EXPECT_EQ(Complaint(Text(truth("2", "100", ""))), "");
}

TEST_F(SequenceReaderTest, ASecondDocumentIsRefused) {
  EXPECT_THAT(Complaint(Text("none") + "---\n" + Text("none")),
              HasSubstr("more than one document"));
}

}  // namespace
}  // namespace fenestra
