#include "experiments/trial/calibrated_rig.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

StereoRigOptions SmallImages() {
  StereoRigOptions options;
  options.width_px = 64;
  options.height_px = 48;
  options.focal_length_m = 4e-4;  // The same view, in a tenth of the pixels' number along a side.
  return options;
}

StereoCalibration Nominal(const StereoRig& rig, const CalibrationChoice& choice, uint64_t seed) {
  return Calibrated(rig, choice, RandomStream(seed), {}).nominal;
}

TEST(CalibrationChoiceTest, ExactIsTheTruthAndDesignTheDrawing) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  EXPECT_EQ(Nominal(rig, {.source = CalibrationSource::kExact}, 2), rig.cameras());
  EXPECT_EQ(Nominal(rig, {.source = CalibrationSource::kDesign}, 2), DesignOf(SmallImages()));
  EXPECT_NE(DesignOf(SmallImages()), rig.cameras());
}

// Rotation vector and translation of one displacement.
struct Displacement {
  Eigen::Vector3d rotation_rad;
  Eigen::Vector3d translation_m;
};

// b = displacement * a.
Displacement Between(const Pose& a, const Pose& b) {
  const Pose between = b * a.inverse();
  const Eigen::AngleAxisd turn(between.rotation());
  return {.rotation_rad = turn.angle() * turn.axis(), .translation_m = between.translation()};
}

// Whether displacements are independent normal variates of zero mean with these standard
// deviations about and along each axis. Each of the six sums of n squares is χ² with n degrees of
// freedom, each mean normal: 12 two-sided tests, that together reject what is right once in 10⁶.
// Sums of the 15 products are normal with variance n, by the central limit: 6 √n is exceeded once
// in 3 10⁷ by any of them.
bool AreNormal(const std::vector<Displacement>& sample, double rotation_rad, double translation_m) {
  constexpr double kTail = 1e-6 / 12.0 / 2.0;
  const auto n = static_cast<double>(sample.size());
  const boost::math::chi_squared of_n(n);
  const boost::math::chi_squared of_one(1.0);
  const double low = boost::math::quantile(of_n, kTail);
  const double high = boost::math::quantile(boost::math::complement(of_n, kTail));
  const double most = boost::math::quantile(boost::math::complement(of_one, 2.0 * kTail));
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 6> products = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Displacement& d : sample) {
    Eigen::Matrix<double, 6, 1> z;
    z << d.rotation_rad / rotation_rad, d.translation_m / translation_m;
    sum += z;
    products += z * z.transpose();
  }
  for (int i = 0; i < 6; ++i) {
    if (products(i, i) < low || products(i, i) > high || sum[i] * sum[i] / n > most) return false;
    for (int j = 0; j < i; ++j) {
      if (std::abs(products(i, j)) > 6.0 * std::sqrt(n)) return false;
    }
  }
  return true;
}

// The test above, and its twins with deviations a quarter off, which it must reject: with 500
// displacements a sum of squares is then off by more than 40 %, and 30 % are enough.
void ExpectNormal(const std::vector<Displacement>& sample, double rotation_rad,
                  double translation_m) {
  EXPECT_TRUE(AreNormal(sample, rotation_rad, translation_m));
  for (const double wrong : {0.8, 1.25}) {
    EXPECT_FALSE(AreNormal(sample, wrong * rotation_rad, translation_m));
    EXPECT_FALSE(AreNormal(sample, rotation_rad, wrong * translation_m));
  }
}

TEST(CalibrationChoiceTest, PerturbedDriftsAsFarAsItIsAskedTo) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  const CalibrationChoice choice{.source = CalibrationSource::kPerturbed,
                                 .rotation_error_rad = 3e-4,
                                 .translation_error_m = 2e-4,
                                 .corner_noise_px = 0.0,
                                 .board_tolerances = kAsDrawn};
  std::vector<Displacement> errors;
  for (uint64_t seed = 0; seed < 500; ++seed) {
    const StereoCalibration nominal = Nominal(rig, choice, seed);
    EXPECT_EQ(nominal.left, rig.cameras().left);
    EXPECT_EQ(nominal.right, rig.cameras().right);
    errors.push_back(Between(rig.cameras().X_RL, nominal.X_RL));
  }
  ExpectNormal(errors, choice.rotation_error_rad, choice.translation_error_m);
  EXPECT_EQ(Nominal(rig, choice, 7), Nominal(rig, choice, 7));
}

// Calibrations of rigs with few pixels: a cache that already holds one for each session with
// boards, so that these cost nothing.
class PreparedBoards {
 public:
  explicit PreparedBoards(const StereoRig& rig) : rig_(rig.WithNoise()), cache_(folder_.path()) {}

  const CalibrationCache& For(const CalibrationChoice& choice, const RandomStream& stream) {
    cache_.Get(ContentOf(rig_, choice, stream.Child("boards")), [] {
      return CalibrationWithCovariance{Known(), PairMatrix::Zero()};
    });
    return cache_;
  }
  static StereoCalibration Known() { return DesignOf(SmallImages()); }

 private:
  testing::TemporaryFolder folder_;
  StereoRig rig_;
  CalibrationCache cache_;
};

TEST(CalibrationChoiceTest, AShakeMovesTheRightCameraAsFarAsItIsAskedTo) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  const CalibrationChoice stale{
      .source = CalibrationSource::kStale, .shake_rotation_rad = 2e-3, .shake_translation_m = 1e-4};
  PreparedBoards prepared(rig);
  std::vector<Displacement> shakes;
  for (uint64_t seed = 0; seed < 500; ++seed) {
    const RandomStream stream(seed);
    const CalibratedRig shaken = Calibrated(rig, stale, stream, prepared.For(stale, stream));
    EXPECT_EQ(shaken.nominal, PreparedBoards::Known());
    EXPECT_EQ(shaken.rig.cameras().left, rig.cameras().left);
    EXPECT_EQ(shaken.rig.cameras().right, rig.cameras().right);
    EXPECT_EQ(shaken.rig.X_BL().translation(), rig.X_BL().translation());
    // About the right camera's own origin, not the body's.
    shakes.push_back(Between(Pose(), rig.X_BR().inverse() * shaken.rig.X_BR()));
  }
  ExpectNormal(shakes, stale.shake_rotation_rad, stale.shake_translation_m);
}

TEST(CalibrationChoiceTest, WithoutAShakeNothingIsStale) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  const CalibrationChoice still{
      .source = CalibrationSource::kStale, .shake_rotation_rad = 0.0, .shake_translation_m = 0.0};
  PreparedBoards prepared(rig);
  const RandomStream stream(3);
  const CalibratedRig same = Calibrated(rig, still, stream, prepared.For(still, stream));
  // One rounding of each composition of poses.
  const Displacement none = Between(rig.cameras().X_RL, same.rig.cameras().X_RL);
  EXPECT_LT(none.rotation_rad.norm(), 1e-15);
  EXPECT_LT(none.translation_m.norm(), 1e-15);
}

TEST(CalibrationChoiceTest, AShakenRigIsToldWhatItWasBefore) {
  const StereoRig rig({}, RandomStream(1));
  const testing::TemporaryFolder folder;
  const CalibrationCache cache(folder.path());
  const CalibrationChoice boards{.source = CalibrationSource::kBoards, .boards = 5};
  CalibrationChoice stale = boards;
  stale.source = CalibrationSource::kStale;
  const CalibratedRig before = Calibrated(rig, boards, RandomStream(3), cache);
  // The shake leaves the boards' random numbers alone, so the second finds the first one's file.
  const CalibratedRig after = Calibrated(rig, stale, RandomStream(3), cache);
  EXPECT_EQ(before.nominal, after.nominal);
  EXPECT_EQ(before.rig.cameras(), rig.cameras());
  EXPECT_NE(after.rig.cameras().X_RL, rig.cameras().X_RL);
  EXPECT_EQ(Calibrated(rig, boards, RandomStream(3), {}).nominal, before.nominal);
}

TEST(CalibrationChoiceTest, BoardsArePhotographedWithNoiseEvenWhereTrialsAreNot) {
  StereoRigOptions options;
  const StereoRig noisy(options, RandomStream(1));
  options.sensor.noise = false;
  options.sensor.fixed_pattern = false;
  const StereoRig noiseless(options, RandomStream(1));
  const CalibrationChoice boards{.source = CalibrationSource::kBoards, .boards = 5};
  EXPECT_EQ(Nominal(noisy, boards, 3), Nominal(noiseless, boards, 3));
}

}  // namespace
}  // namespace fenestra
