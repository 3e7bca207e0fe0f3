#include "experiments/trial/calibrated_rig.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace fenestra {
namespace {

StereoRigOptions SmallImages() {
  StereoRigOptions options;
  options.width_px = 64;
  options.height_px = 48;
  options.focal_length_m = 4e-4;
  return options;
}

// Errors of nominal calibrations, held against their covariance: e⁺ᵀ C⁻¹ e summed over
// rigs is χ² with as many degrees of freedom as C has ranks, times the rigs.
struct Agreement {
  double sum = 0.0;
  int freedom = 0;

  // Two-sided, wrong once in 10⁴.
  bool IsHonest(double scale = 1.0) const {
    const boost::math::chi_squared distribution(freedom);
    return scale * sum > quantile(distribution, 5e-5) &&
           scale * sum < quantile(complement(distribution, 5e-5));
  }
};

Agreement AgreementOf(const CalibrationChoice& choice) {
  Agreement agreement;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const StereoRig rig(SmallImages(), RandomStream(seed).Child("rig"));
    const CalibratedRig calibrated = Calibrated(rig, choice, RandomStream(seed), {});
    const PairVector error = PairError(calibrated.nominal, rig.cameras());
    const PairMatrix covariance = calibrated.covariance.value();
    // In units of each parameter, so that their sizes do not hide the rank.
    const PairVector units = covariance.diagonal().cwiseSqrt().cwiseMax(1e-12);
    const PairVector inverse = units.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<PairMatrix> solver(inverse.asDiagonal() * covariance *
                                                           inverse.asDiagonal());
    const PairVector in_axes = solver.eigenvectors().transpose() * inverse.cwiseProduct(error);
    for (int i = 0; i < kPairParameters; ++i) {
      if (solver.eigenvalues()[i] < 1e-6) continue;
      agreement.sum += in_axes[i] * in_axes[i] / solver.eigenvalues()[i];
      ++agreement.freedom;
    }
  }
  return agreement;
}

TEST(CalibrationCovarianceTest, StatesHowFarWhatIsToldIsFromTheTruth) {
  for (const CalibrationChoice& choice :
       {CalibrationChoice{.source = CalibrationSource::kPerturbed,
       .rotation_error_rad = 2e-3,
       .translation_error_m = 1e-4},
        CalibrationChoice{.source = CalibrationSource::kDesign}}) {
    const Agreement agreement = AgreementOf(choice);
    // All of the pair; of a design six of the pose, and f, cx, cy, k1, k2, p1 and p2 of two
    // cameras.
    EXPECT_EQ(agreement.freedom / 300, choice.source == CalibrationSource::kDesign ? 20 : 24);
    EXPECT_TRUE(agreement.IsHonest()) << agreement.sum / agreement.freedom;
    EXPECT_FALSE(agreement.IsHonest(2.0));
    EXPECT_FALSE(agreement.IsHonest(0.5));
  }
}

// Recorded: jack-knife over five sets of 16 to 51 pairs.
TEST(CalibrationCovarianceTest, APerturbedRigErrsAsRecordedOnesScatter) {
  StereoRigOptions options;
  options.as_designed = true;
  const StereoRig rig(options, RandomStream(1));
  const double focal_px = rig.cameras().left.parameters().fx_px;
  struct Scatter {
    double focal_length;
    double baseline;
    double far_disparity_px;  // Of a far point in the centre.
  };
  const auto scatter = [&](const CalibrationChoice& choice) {
    const PairMatrix covariance = CalibrationCovariance(rig, choice, {}).value();
    PairVector far = PairVector::Zero();
    far[2] = 1.0;
    far[kCameraParameters + 2] = -1.0;
    far[2 * kCameraParameters + 1] = -focal_px;
    return Scatter{.focal_length = std::sqrt(covariance(0, 0)) / focal_px,
                   .baseline = std::sqrt(covariance(21, 21)) / options.baseline_m,
                   .far_disparity_px = std::sqrt(far.dot(covariance * far))};
  };
  const auto is_recorded = [](const Scatter& s) {
    return s.focal_length > 7e-4 && s.focal_length < 1e-2 && s.baseline > 4.7e-4 &&
           s.baseline < 2e-3 && s.far_disparity_px > 0.06 && s.far_disparity_px < 0.9;
  };
  EXPECT_TRUE(is_recorded(scatter({})));
  // The twin: boards as drawn.
  EXPECT_FALSE(is_recorded(scatter({.board_tolerances = kAsDrawn})));
}

TEST(CalibrationCovarianceTest, ExactIsCertainAndAShakeAddsToTheBoards) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  EXPECT_FALSE(CalibrationCovariance(rig, {.source = CalibrationSource::kExact}, {}).has_value());
  const PairMatrix boards = 1e-8 * PairMatrix::Identity();
  EXPECT_EQ(CalibrationCovariance(rig, {.source = CalibrationSource::kBoards}, boards), boards);
  const PairMatrix stale = *CalibrationCovariance(
      rig, {.source = CalibrationSource::kStale, .shake_rotation_rad = 1e-3}, boards);
  EXPECT_NEAR(stale(19, 19), 1e-8 + 1e-6, 1e-15);
  EXPECT_EQ(stale(0, 0), 1e-8);
  EXPECT_THROW(CalibrationCovariance(rig, {.source = CalibrationSource::kBoards}, {}),
               std::logic_error);
}

}  // namespace
}  // namespace fenestra
