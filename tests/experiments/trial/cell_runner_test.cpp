#include "experiments/trial/cell_runner.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "experiments/study_file/study_reader.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

// Small pictures, so that trials take little time.
Study StudyOf(const std::string& factors, const std::string& sensor = "stereo") {
  const std::string small = sensor == "stereo" ? "  stereo_width_px: 188\n  stereo_height_px: 120\n"
                                                 "  stereo_pixel_pitch_um: 24\n"
                                               : "";
  return ReadStudy(YamlReader::FromText("name: bench\nrepetitions: 4\nsensors: [" + sensor +
                                            "]\nfactors:\n" + small + factors,
                                        "bench.yaml"),
                   Detectors());
}

CellRunner BenchOf(const Study& study, int cell = 0) {
  return {study, CellOf(study, cell)};
}

int Differing(const SimulatedTrial& a, const SimulatedTrial& b) {
  const auto& left = std::get<StereoObservation>(a.observation);
  const auto& right = std::get<StereoObservation>(b.observation);
  return cv::countNonZero(left.left != right.left) + cv::countNonZero(left.right != right.right);
}

TEST(CellRunner, ATrialIsAFunctionOfItsIndex) {
  const Study study = StudyOf("  yaw_deg: {uniform: [-5, 5]}\n");
  const CellRunner bench = BenchOf(study);
  const SimulatedTrial once = bench.Simulate(2);
  EXPECT_EQ(Differing(once, bench.Simulate(2)), 0);
  EXPECT_EQ(Differing(once, BenchOf(study).Simulate(2)), 0);
  EXPECT_GT(Differing(once, bench.Simulate(3)), 1000);
}

TEST(CellRunner, TheTruthIsThatOfTheTrialsSettings) {
  const Study study = StudyOf("  distance_m: {uniform: [2, 4]}\n  stereo_as_designed: true\n");
  const CellRunner bench = BenchOf(study);
  for (int trial = 0; trial < 3; ++trial) {
    const SimulatedTrial simulated = bench.Simulate(trial);
    const double distance_m = simulated.trial.settings.viewpoint.distance_m;
    EXPECT_EQ(std::get<double>(simulated.trial.drawn.at(0).second), distance_m);
    // From the rig's middle; the left camera is half a baseline aside.
    const Eigen::Vector3d& p_CO = simulated.truth.target.value().p_CO;
    EXPECT_NEAR(p_CO.z(), distance_m, 1e-6);
    EXPECT_NEAR(p_CO.head<2>().norm(), 0.5 * simulated.trial.settings.stereo.baseline_m, 1e-6);
  }
}

TEST(CellRunner, CellsShareARigUnlessTrialsDrawOne) {
  const std::string levels = "  distance_m: [2, 3]\n";
  const auto left = [](const SimulatedTrial& simulated) {
    return std::get<StereoCalibration>(simulated.calibration).left.parameters();
  };
  const Study shared =
      StudyOf(levels + "  stereo_calibration: exact\n  stereo_rig_per_trial: false\n");
  EXPECT_EQ(left(BenchOf(shared, 0).Simulate(0)), left(BenchOf(shared, 1).Simulate(3)));
  const Study drawn =
      StudyOf(levels + "  stereo_calibration: exact\n  stereo_rig_per_trial: true\n");
  const CellRunner bench = BenchOf(drawn);
  EXPECT_NE(left(bench.Simulate(0)).fx_px, left(bench.Simulate(1)).fx_px);
  EXPECT_EQ(left(bench.Simulate(1)), left(BenchOf(drawn, 1).Simulate(1)));
}

TEST(CellRunner, ARowNamesItsTrialAndItsDetector) {
  const Study study = StudyOf("  distance_m: [2, 3]\n  yaw_deg: {uniform: [-1, 1]}\n");
  const CellRunner bench = BenchOf(study, 1);
  const SimulatedTrial simulated = bench.Simulate(2);
  ASSERT_GE(bench.detectors().size(), 2u);
  for (size_t i = 0; i < bench.detectors().size(); ++i) {
    const Attempt attempt = bench.Try(i, simulated, false);
    const TrialRecord& row = attempt.record;
    EXPECT_EQ(row.cell, 1);
    EXPECT_EQ(row.trial, 2);
    EXPECT_EQ(row.part, "main");
    EXPECT_EQ(row.detector, bench.detectors()[i].label);
    EXPECT_EQ(row.levels, bench.cell().levels);
    EXPECT_EQ(row.drawn, simulated.trial.drawn);
    EXPECT_TRUE(row.score.HasTarget());
    EXPECT_FALSE(row.stages.empty());
    EXPECT_TRUE(attempt.log.pictures().empty());
    ASSERT_TRUE(row.bound_C.has_value());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(*row.bound_C).eigenvalues().minCoeff(),
              0.0);
  }
}

TEST(CellRunner, PicturesOfStagesAreKeptOnRequestAndChangeNothing) {
  const Study study = StudyOf("  distance_m: 2\n");
  const CellRunner bench = BenchOf(study);
  const SimulatedTrial simulated = bench.Simulate(0);
  const Attempt plain = bench.Try(0, simulated, false);
  const Attempt drawn = bench.Try(0, simulated, true);
  EXPECT_FALSE(drawn.log.pictures().empty());
  EXPECT_EQ(plain.record.score.outcome, drawn.record.score.outcome);
  EXPECT_EQ(plain.record.score.CentroidErrorOrInfinity_m(),
            drawn.record.score.CentroidErrorOrInfinity_m());
}

TEST(CellRunner, ASceneWithoutATargetHasNeitherTruthNorBound) {
  const Study study = StudyOf("  target: false\n");
  const CellRunner bench = BenchOf(study);
  const SimulatedTrial simulated = bench.Simulate(0);
  EXPECT_FALSE(simulated.truth.target.has_value());
  EXPECT_FALSE(simulated.information.has_value());
  const TrialRecord row = bench.Try(0, simulated, false).record;
  EXPECT_TRUE(row.score.outcome == Outcome::kClear || row.score.outcome == Outcome::kFalseAlarm);
  EXPECT_FALSE(row.bound_C.has_value());
}

TEST(CellRunner, TruthImagesHaveTheSizeOfTheScoredCamera) {
  const Study stereo = StudyOf("  distance_m: 2\n");
  const CellRunner bench = BenchOf(stereo);
  const SimulatedTrial simulated = bench.Simulate(0);
  EXPECT_EQ(bench.TruthOf(simulated).aovs.depth_m.size(), cv::Size(188, 120));
  EXPECT_FALSE(bench.DepthOf(simulated).has_value());
}

TEST(CellRunner, ADepthSensorSaysWhyPixelsHaveNoReturn) {
  const Study rgbd = StudyOf("  distance_m: 1.5\n", "rgbd");
  const CellRunner bench = BenchOf(rgbd);
  const SimulatedTrial simulated = bench.Simulate(0);
  const auto frame = bench.DepthOf(simulated);
  ASSERT_TRUE(frame.has_value());
  const cv::Mat1w& seen = std::get<RgbdObservation>(simulated.observation).depth.raw;
  EXPECT_EQ(cv::countNonZero(frame->depth.raw != seen), 0);
}

// The left camera turns with the rig, half a baseline from its middle: v + ω × r.
TEST(CellRunner, TheTrueSensorMovesAsTheRigDoes) {
  const std::string no_hover = "  stereo_hover_speed_m_s: 0\n  stereo_hover_turn_deg_s: 0\n";
  const Study still = StudyOf("  stereo_as_designed: true\n" + no_hover);
  const CellRunner bench = BenchOf(still);
  EXPECT_EQ(bench.SensorOf(bench.Simulate(0)).velocity_W.norm(), 0.0);
  const Study moving = StudyOf(
      "  stereo_as_designed: true\n  stereo_speed_forward_m_s: 0.5\n"
      "  stereo_yaw_rate_deg_s: 30\n" +
      no_hover);
  const CellRunner turning = BenchOf(moving);
  const double radius_m = 0.5 * turning.cell().settings.stereo.baseline_m;
  // Forwards, and sideways-on the left camera goes along the axis as well: ω y × -r x = +ω r z.
  const double expected = 0.5 + 30.0 * M_PI / 180.0 * radius_m;
  EXPECT_NEAR(turning.SensorOf(turning.Simulate(0)).velocity_W.norm(), expected, 1e-9);
}

}  // namespace
}  // namespace fenestra
