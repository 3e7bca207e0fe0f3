#include "experiments/cramer_rao/trial_information.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/gamma.hpp>

#include "core/io/yaml_reader.h"
#include "experiments/report/bound_table.h"
#include "experiments/study_file/study_reader.h"
#include "experiments/trial/cell_runner.h"

namespace fenestra {
namespace {

Study StudyOf(const std::string& text) {
  return ReadStudy(YamlReader::FromText(text, "study.yaml"), Detectors());
}

constexpr char kStereo[] =
    "name: near\n"
    "repetitions: 1\n"
    "sensors: [stereo]\n"
    "detectors:\n"
    "  - {name: edge-stereo}\n"
    "  - {name: edge-stereo, label: unaware, options: {edge_shift_px: 0, corner_edge_shift_px: "
    "0}}\n"
    "factors:\n"
    "  stereo_calibration: exact\n"
    "  distance_m: 3\n"
    "  sky_illuminance_lx: 500\n"
    "  roll_deg: {uniform: [-4, 4]}\n"
    "  yaw_deg: {uniform: [-2, 2]}\n";

// The bound knows neither coma nor motion; what they add is what the detector states of them.
TEST(TrialInformationTest, ADetectorOfEdgesComesNearTheBoundOfRenderedTrialsAndNotBelow) {
  constexpr int kTrials = 60;
  const Study study = StudyOf(kStereo);
  const CellRunner runner(study, CellOf(study, 0));
  double by_bound = 0.0;
  double by_both = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const SimulatedTrial simulated = runner.Simulate(trial);
    const TrialRecord record = runner.Try(0, simulated, false).record;
    const TrialRecord unaware = runner.Try(1, simulated, false).record;
    ASSERT_EQ(record.score.outcome, Outcome::kHit) << record.score.reason;
    ASSERT_TRUE(record.bound_C.has_value());
    const Eigen::Vector3d error = record.score.CentroidError_C().value();
    const Eigen::Matrix3d shift =
        record.score.estimate->covariance_C.value() - unaware.score.estimate->covariance_C.value();
    by_bound += error.dot(record.bound_C->inverse() * error);
    by_both += error.dot((*record.bound_C + shift).inverse() * error);
  }
  // χ² of three degrees of freedom a trial for an estimate that attains the bound: less once in a
  // thousand.
  const boost::math::chi_squared attained(3.0 * kTrials);
  EXPECT_GT(by_bound, quantile(attained, 1e-3)) << by_bound / kTrials;
  // Errors of 1.3 times those at most. Squares have a variance of 24 instead of 6, see
  // edge_stereo_covariance_test: more once in a thousand.
  const boost::math::gamma_distribution<> most(3.0 * kTrials * 3.0 / 24.0, 24.0 / 3.0);
  EXPECT_LT(by_both, 1.3 * 1.3 * quantile(most, 0.999)) << by_both / kTrials;
  // The twin: without what the detector states of coma and motion.
  EXPECT_GT(by_bound, 1.3 * 1.3 * quantile(most, 0.999)) << by_bound / kTrials;
}

TEST(TrialInformationTest, DetectorsAreBoundByWhatTheyKnow) {
  const DetectorChoice plain{
      .label = "a", .name = "a", .sensor = SensorKind::kStereo, .options = {}};
  DetectorChoice sized = plain;
  sized.options = {
      {"expected_width_m", 1.0}, {"expected_height_m", 1.0}, {"expected_size_sigma_m", 0.003}};
  DetectorChoice unsized = sized;
  unsized.options["expected_width_m"] = 0.0;
  const TrialInformation exact{SensorKind::kStereo, {}, {}};
  const TrialInformation told{SensorKind::kStereo, {}, PairMatrix(PairMatrix::Identity())};
  EXPECT_EQ(PriorKnowledgeOf(sized, exact).size_sigma_m, 0.003);
  EXPECT_FALSE(PriorKnowledgeOf(unsized, exact).size_sigma_m.has_value());
  EXPECT_FALSE(PriorKnowledgeOf(plain, exact).size_sigma_m.has_value());
  EXPECT_FALSE(PriorKnowledgeOf(plain, exact).calibration.has_value());
  EXPECT_EQ(PriorKnowledgeOf(plain, told).calibration, *told.calibration);
}

TEST(TrialInformationTest, OutOfViewAndWithoutATargetThereIsNone) {
  for (const char* factor : {"  yaw_deg: 25\n", "  target: false\n"}) {
    const Study study = StudyOf(std::string("name: none\n"
                                            "repetitions: 1\n"
                                            "sensors: [stereo, rgbd]\n"
                                            "factors:\n"
                                            "  distance_m: 3\n") +
                                factor);
    for (const Cell& cell : Cells(study)) {
      EXPECT_FALSE(CellRunner(study, cell).Simulate(0).information.has_value()) << factor;
    }
  }
}

TEST(BoundTableTest, KnowledgeOrdersTheBounds) {
  const Study study = StudyOf(
      "name: two\n"
      "repetitions: 1\n"
      "sensors: [stereo, rgbd]\n"
      "factors:\n"
      "  sky_illuminance_lx: 500\n"
      "  distance_m: [2, 3]\n");
  std::vector<CellBounds> cells;
  for (const Cell& cell : Cells(study)) cells.push_back(BoundsOfCell(study, cell, 1));
  ASSERT_EQ(cells.size(), 4u);
  for (const CellBounds& cell : cells) {
    ASSERT_EQ(cell.in_view, 1);
    const auto of = [&](Known known) { return cell.bounds[static_cast<size_t>(known)]; };
    ASSERT_TRUE(of(Known::kGeometry).has_value());
    EXPECT_LT(of(Known::kGeometryAndSize)->all, of(Known::kGeometry)->all);
    EXPECT_LT(of(Known::kGeometry)->all, of(Known::kNominal)->all);
    EXPECT_LE(of(Known::kGeometryAndSize)->all, of(Known::kSize)->all);
  }
  EXPECT_GT(cells[1].bounds[1]->depth, cells[0].bounds[1]->depth);
  EXPECT_NE(BoundTable(cells).find("geom z"), std::string::npos);
}

}  // namespace
}  // namespace fenestra
