#include "experiments/trial/calibrated_rig.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <boost/math/distributions/chi_squared.hpp>

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
    // Six of the pose; besides, f, cx, cy, k1, k2, p1 and p2 of two cameras.
    EXPECT_EQ(agreement.freedom / 300, choice.source == CalibrationSource::kDesign ? 20 : 6);
    EXPECT_TRUE(agreement.IsHonest()) << agreement.sum / agreement.freedom;
    EXPECT_FALSE(agreement.IsHonest(2.0));
    EXPECT_FALSE(agreement.IsHonest(0.5));
  }
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
