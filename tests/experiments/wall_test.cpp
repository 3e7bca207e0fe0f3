// The wall between truth and estimate.

#include <gtest/gtest.h>

#include "core/detection/observation.h"
#include "experiments/study_file/study_reader.h"
#include "experiments/trial/cell_runner.h"
#include "experiments/trial/scoring.h"
#include "experiments/trial_files/trial_files.h"
#include "tests/support/temporary_folder.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

using testing::ReadFile;
using testing::TemporaryFolder;

Study SmallStudy() {
  return ReadStudy(YamlReader::FromText("name: wall\n"
                                        "repetitions: 1\n"
                                        "sensors: [stereo, rgbd]\n"
                                        "factors:\n"
                                        "  distance_m: 1.5\n"
                                        "  window_width_m: 0.8\n"
                                        "  window_height_m: 0.8\n"
                                        "  yaw_deg: {uniform: [-1, 1]}\n",
                                        "wall.yaml"),
                   Detectors());
}

bool SameBits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a == b;
}

void ExpectSameDetection(const Detection& a, const Detection& b) {
  ASSERT_EQ(a.index(), b.index());
  if (const auto* miss = std::get_if<Miss>(&a)) {
    EXPECT_EQ(miss->reason, std::get<Miss>(b).reason);
    EXPECT_EQ(miss->detail, std::get<Miss>(b).detail);
    return;
  }
  const auto& x = std::get<WindowEstimate>(a);
  const auto& y = std::get<WindowEstimate>(b);
  EXPECT_TRUE(SameBits(x.p_CO, y.p_CO));
  EXPECT_TRUE(SameBits(x.normal_C, y.normal_C));
  for (size_t i = 0; i < 4; ++i) EXPECT_TRUE(SameBits(x.p_CV[i], y.p_CV[i]));
}

Detection Detect(const DetectorChoice& choice, const SensorCalibration& calibration,
                 const Observation& observation) {
  StageLog log([] { return 0.0; });
  return MakeDetector(choice.name, calibration, choice.options)->Detect(observation, log);
}

TEST(WallTest, EstimatesFromFilesAreThoseInProcess) {
  const Study study = SmallStudy();
  for (const Cell& cell : Cells(study)) {
    const CellRunner runner(study, cell);
    const SimulatedTrial simulated = runner.Simulate(0);
    const TemporaryFolder folder;
    WriteObservation(folder.path(), simulated.observation, simulated.calibration);
    const RecordedObservation files =
        ReadObservation(ObservationFiles::In(folder.path(), cell.sensor));
    for (const DetectorChoice& choice : runner.detectors()) {
      const Detection in_process = Detect(choice, simulated.calibration, simulated.observation);
      EXPECT_TRUE(std::holds_alternative<WindowEstimate>(in_process)) << choice.name;
      ExpectSameDetection(in_process, Detect(choice, files.calibration, files.observation));
    }
  }
}

TEST(WallTest, SamePixelsGiveTheSameEstimateWhateverTheTruth) {
  const Study study = SmallStudy();
  for (const Cell& cell : Cells(study)) {
    const CellRunner runner(study, cell);
    const SimulatedTrial simulated = runner.Simulate(0);
    SimulatedTrial lying = simulated;
    lying.truth.X_WC = Pose(RotationFromVector({0.3, 0.2, 0.1}), {7.0, 8.0, 9.0});
    lying.truth.target->p_CO += Eigen::Vector3d(1.0, -2.0, 3.0);
    lying.truth.target->width_m *= 3.0;
    lying.trial.settings.viewpoint.distance_m = 77.0;
    for (size_t i = 0; i < runner.detectors().size(); ++i) {
      const Attempt honest = runner.Try(i, simulated, false);
      const Attempt blind = runner.Try(i, lying, false);
      ASSERT_TRUE(honest.record.score.estimate);
      ASSERT_TRUE(blind.record.score.estimate);
      ExpectSameDetection(*honest.record.score.estimate, *blind.record.score.estimate);
      EXPECT_NE(honest.record.score.outcome, blind.record.score.outcome);
    }
  }
}

TEST(WallTest, WhyPixelsHaveNoReturnStandsInTheTruthAlone) {
  const Study study = SmallStudy();
  bool any = false;
  for (const Cell& cell : Cells(study)) {
    const CellRunner runner(study, cell);
    const SimulatedTrial simulated = runner.Simulate(0);
    const auto* seen = std::get_if<RgbdObservation>(&simulated.observation);
    const std::optional<ExplainedDepth> depth = runner.DepthOf(simulated);
    ASSERT_EQ(seen != nullptr, depth.has_value());
    if (seen == nullptr) continue;
    any = true;
    // The same frame again, to the bit, and a reason wherever it has no return.
    EXPECT_EQ(cv::countNonZero(depth->depth.raw != seen->depth.raw), 0);
    EXPECT_EQ(cv::countNonZero((depth->no_return == 0) != (seen->depth.raw != 0)), 0);
    const TemporaryFolder folder;
    WriteTrialFiles(folder.path(), runner, simulated);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "truth" / "no_return.png"));
  }
  EXPECT_TRUE(any);
}

TEST(WallTest, WhatADetectorCanReadNamesNoTruth) {
  const Study study = SmallStudy();
  const std::set<std::string> allowed = {"left.png",  "right.png", "color.png",
                                         "depth.png", "cloud.pcd", "calibration.yaml"};
  for (const Cell& cell : Cells(study)) {
    const CellRunner runner(study, cell);
    const TemporaryFolder folder;
    WriteTrialFiles(folder.path(), runner, runner.Simulate(0));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename();
      if (name == "truth") continue;
      EXPECT_TRUE(allowed.contains(name)) << name;
      const std::string bytes = ReadFile(entry.path());
      for (const char* secret : {"truth", "target", "world", "frame", "wall", "tEXt"}) {
        EXPECT_EQ(bytes.find(secret), std::string::npos) << name << " says " << secret;
      }
    }
  }
}

}  // namespace
}  // namespace fenestra
