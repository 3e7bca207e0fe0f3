#include "experiments/sequence/score_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "core/geometry/calibration.h"
#include "core/io/input_error.h"
#include "experiments/report/report.h"
#include "experiments/run/run_study.h"
#include "experiments/sequence/sequence_writer.h"
#include "experiments/store/store.h"
#include "experiments/study_file/study_reader.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::vector<TrialRecord> RowsIn(const fs::path& folder) {
  std::vector<TrialRecord> rows = ResultStore::OpenReadOnly(folder / "results.sqlite").Rows();
  for (TrialRecord& row : rows) {
    row.stages.clear();   // Times differ from run to run.
    row.bound_C.reset();  // A recording does not say of what it would be the bound.
  }
  return rows;
}

class SimulatedSequenceTest : public ::testing::TestWithParam<SensorKind> {};

TEST_P(SimulatedSequenceTest, ScoredIsTheStudyThatMadeIt) {
  const TemporaryFolder folder;
  const std::string sensor = ToString(GetParam());
  // At 1.1 m the window is partly out of view for some yaws; other windows and none at all, too.
  const std::string text = "name: made\nrepetitions: 2\nsensors: [" + sensor +
                           "]\nfactors:\n  distance_m: [1.1, 2]\n  target: [true, false]\n"
                           "  yaw_deg: {uniform: [-9, 9]}\n";
  const Study study = ReadStudy(YamlReader::FromText(text, "made.yaml"), Detectors());
  RunStudy({.study = study, .study_text = text, .out = folder / "study"});

  EXPECT_EQ(WriteSequence(folder / "sequence", study, GetParam()), 8);
  const Sequence sequence = ReadSequence(folder / "sequence/sequence.yaml");
  EXPECT_EQ(sequence.detectors.size(), study.parts[0].detectors.size());
  ScoreSequence({.sequence = sequence, .made = {}, .out = folder / "scored"});
  const std::vector<TrialRecord> made = RowsIn(folder / "study");
  EXPECT_EQ(TrialsCsv(RowsIn(folder / "scored")), TrialsCsv(made));
  EXPECT_TRUE(std::any_of(made.begin(), made.end(),
                          [](const TrialRecord& r) { return r.score.estimate.has_value(); }));
  for (const char* name : {"trials.csv", "summary.csv", "summary.md"}) {
    EXPECT_TRUE(fs::exists(folder.path() / "scored" / name)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(BothSensors, SimulatedSequenceTest,
                         ::testing::Values(SensorKind::kStereo, SensorKind::kRgbd),
                         [](const auto& test) { return ToString(test.param); });

/// The recorded frame of tests/data, beside a calibration that its authors published.
class RecordedSequenceTest : public ::testing::Test {
 protected:
  RecordedSequenceTest() {
    const CameraModel camera({.width_px = 640,
                              .height_px = 480,
                              .fx_px = 520.9,
                              .fy_px = 521.0,
                              .cx_px = 325.1,
                              .cy_px = 249.7,
                              .distortion = {}});
    folder_.Write("rgbd.yaml", ToOpenCvYaml(RgbdCalibration{camera, camera, Pose(), 1.0 / 5000.0}));
    const fs::path data = fs::path(FENESTRA_SOURCE_DIR) / "tests/data/rgbd-tum";
    for (const char* name : {"color.png", "depth.png"}) {
      fs::copy_file(data / name, folder_ / name);
    }
  }

  /// The screen's black front, read off the images by hand: pixels (242…374, 113…211) at 1.53 m.
  std::string Text(const std::string& truth) const {
    return "name: desk\nsensor: rgbd\ncalibration: rgbd.yaml\ndetectors:\n  - {name: paper-rgbd, "
           "options: {cloud: largest_component}}\nframes:\n  - {color: color.png, depth: "
           "depth.png, truth: " +
           truth + "}\n";
  }

  TemporaryFolder folder_;
};

constexpr const char* kScreen =
    "{centroid_m: [-0.05, -0.258, 1.53], width_m: 0.39, height_m: 0.29}";

TEST_F(RecordedSequenceTest, ASurveyedFrameIsAHit) {
  const Sequence sequence = ReadSequence(folder_.Write("sequence.yaml", Text(kScreen)));
  const auto summaries =
      ScoreSequence({.sequence = sequence, .made = {}, .out = folder_ / "scored"});
  ASSERT_EQ(summaries.size(), 1u);
  EXPECT_EQ(summaries[0].counts[Outcome::kHit], 1);
  // Read off by hand to about a centimetre; a quarter of the lower side would be 7 cm.
  EXPECT_LT(summaries[0].Value("p50_error_mm").value(), 50.0);
}

TEST_F(RecordedSequenceTest, DetectionsThatWereMadeElsewhereAreScoredAlike) {
  Sequence sequence = ReadSequence(folder_.Write("sequence.yaml", Text(kScreen)));
  sequence.detectors.clear();
  WindowEstimate estimate;
  estimate.p_CO = {-0.05, -0.258, 1.54};
  estimate.p_CV.fill(estimate.p_CO);
  StageLog log([] { return 0.0; });
  const std::string json = DetectionJson("mine", estimate, log);
  const auto file = folder_.Write("mine.json", json);
  const auto summaries = ScoreSequence(
      {.sequence = sequence, .made = {ReadDetections("mine", file, 1)}, .out = folder_ / "scored"});
  ASSERT_EQ(summaries.size(), 1u);
  EXPECT_NEAR(summaries[0].Value("rmse_mm").value(), 10.0, 1e-9);

  EXPECT_THROW(ReadDetections("mine", file, 2), InputError);
  EXPECT_EQ(ReadDetections("mine", folder_.Write("two.json", json + json), 2).detections.size(),
            2u);
  EXPECT_THROW(ReadDetections("mine", folder_.Write("cut.json", json.substr(0, 90)), 1),
               InputError);
  EXPECT_THROW(ReadDetections("mine", folder_.Write("list.json", "[1]"), 1), InputError);
  EXPECT_THROW(ReadDetections("mine", folder_ / "missing.json", 1), InputError);
}

TEST_F(RecordedSequenceTest, AnImageThatCannotBeReadIsNamedAndNothingIsWritten) {
  folder_.Write("color.png", "no image");
  const Sequence sequence = ReadSequence(folder_.Write("sequence.yaml", Text("none")));
  try {
    ScoreSequence({.sequence = sequence, .made = {}, .out = folder_ / "scored"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("color.png"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "scored"));
}

// A frame that the detectors refuse ends the command, as it ends `detect`: no row says "crashed".
class UnfitSequenceTest : public ::testing::Test {
 protected:
  std::string Complaint(const std::string& detectors) {
    const Sequence sequence = ReadSequence(folder_.Write(
        "sequence.yaml",
        "name: unfit\nsensor: stereo\ncalibration: stereo.yaml\ndetectors: " + detectors +
            "\nframes:\n  - {left: l.png, right: r.png, truth: none}\n"));
    const auto maker =
        std::make_shared<DetectorMaker>(std::vector<std::string>{FENESTRA_PROGRAM, "serve"});
    try {
      ScoreSequence(
          {.sequence = sequence, .made = {}, .out = folder_ / "scored", .detectors = maker});
    } catch (const InputError& error) {
      EXPECT_FALSE(fs::exists(folder_ / "scored"));
      return error.what();
    }
    return "none";
  }

  void WritePair(const Pose& X_RL, const cv::Size& left, const cv::Size& right) {
    const CameraModel camera = CameraModel::Pinhole(320, 240, 300.0);
    folder_.Write("stereo.yaml", ToOpenCvYaml(StereoCalibration{camera, camera, X_RL}));
    cv::imwrite((folder_ / "l.png").string(), cv::Mat1b(left, 128));
    cv::imwrite((folder_ / "r.png").string(), cv::Mat1b(right, 128));
  }

  TemporaryFolder folder_;
};

TEST_F(UnfitSequenceTest, ACalibrationThatADetectorRefusesIsNoCrash) {
  const cv::Size size(320, 240);
  for (const Eigen::Vector3d& p_RL : {Eigen::Vector3d(0.35, 0, 0), Eigen::Vector3d(0, -0.35, 0)}) {
    WritePair(Pose::Translation(p_RL), size, size);
    for (const char* detectors :
         {"[edge-stereo]", "[paper-stereo]", "[{name: edge-stereo, isolate: true}]"}) {
      EXPECT_THAT(Complaint(detectors), HasSubstr("must stand to the right")) << detectors;
    }
  }
}

TEST_F(UnfitSequenceTest, ImagesOfAnotherSizeThanTheCalibrationsAreNoCrash) {
  const Pose X_RL = Pose::Translation({-0.35, 0, 0});
  WritePair(X_RL, {160, 120}, {320, 240});
  EXPECT_THAT(Complaint("[edge-stereo]"),
              HasSubstr("l.png: is 160 x 120 px; the calibration is for 320 x 240 px"));
  WritePair(X_RL, {320, 240}, {240, 320});
  EXPECT_THAT(Complaint("[{name: paper-stereo, isolate: true}]"), HasSubstr("r.png: is 240 x 320"));
}

}  // namespace
}  // namespace fenestra
