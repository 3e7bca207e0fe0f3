#include "experiments/calibration_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/board_calibration.h"

namespace fenestra {
namespace {

StereoRigOptions SmallImages() {
  StereoRigOptions options;
  options.width_px = 64;
  options.height_px = 48;
  options.focal_length_m = 4e-4;  // The same view, in a tenth of the pixels' number along a side.
  return options;
}

StereoCalibration Told(const StereoRig& rig, const CalibrationChoice& choice, uint64_t seed) {
  return Calibrated(rig, choice, RandomStream(seed), {}).told;
}

TEST(CalibrationChoiceTest, ExactIsTheTruthAndDesignTheDrawing) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  EXPECT_EQ(Told(rig, {.source = CalibrationSource::kExact}, 2), rig.cameras());
  EXPECT_EQ(Told(rig, {.source = CalibrationSource::kDesign}, 2), DesignOf(SmallImages()));
  EXPECT_NE(DesignOf(SmallImages()), rig.cameras());
}

TEST(CalibrationChoiceTest, PerturbedErrsByWhatItIsAskedFor) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  const CalibrationChoice choice{.source = CalibrationSource::kPerturbed,
                                 .rotation_error_rad = 3e-4,
                                 .translation_error_m = 2e-4};
  constexpr int kDraws = 500;
  double rotation = 0.0;
  double translation = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const StereoCalibration told = Told(rig, choice, static_cast<uint64_t>(i));
    EXPECT_EQ(told.left, rig.cameras().left);
    EXPECT_EQ(told.right, rig.cameras().right);
    const Pose error = told.X_RL * rig.cameras().X_RL.inverse();
    rotation += std::pow(Eigen::AngleAxisd(error.rotation()).angle(), 2);
    translation += error.translation().squaredNorm();
  }
  // Sums of 3 n squares of normal variates: χ², within 4 of its standard deviations √(6 n).
  const double spread = 4.0 * std::sqrt(6.0 * kDraws);
  EXPECT_NEAR(rotation / std::pow(choice.rotation_error_rad, 2), 3.0 * kDraws, spread);
  EXPECT_NEAR(translation / std::pow(choice.translation_error_m, 2), 3.0 * kDraws, spread);
}

TEST(CalibrationChoiceTest, AShakenRigIsToldWhatItWasBefore) {
  const StereoRig rig({}, RandomStream(1));
  const CalibrationChoice boards{.source = CalibrationSource::kBoards, .boards = 8};
  CalibrationChoice stale = boards;
  stale.source = CalibrationSource::kStale;
  stale.shake_rotation_rad = 2e-3;
  const CalibratedRig before = Calibrated(rig, boards, RandomStream(3), {});
  const CalibratedRig after = Calibrated(rig, stale, RandomStream(3), {});
  EXPECT_EQ(before.told, after.told);
  EXPECT_EQ(before.rig.cameras(), rig.cameras());
  const Pose shake = after.rig.cameras().X_RL * rig.cameras().X_RL.inverse();
  const double angle_rad = Eigen::AngleAxisd(shake.rotation()).angle();
  EXPECT_GT(angle_rad, 2e-4);
  EXPECT_LT(angle_rad, 2e-2);
  // Eight boards tell a rig to some tenths of a milliradian and of a millimetre.
  const Pose error = before.told.X_RL * rig.cameras().X_RL.inverse();
  EXPECT_GT(Eigen::AngleAxisd(error.rotation()).angle(), 0.0);
  EXPECT_LT(Eigen::AngleAxisd(error.rotation()).angle(), 1e-3);
  EXPECT_LT(error.translation().norm(), 1e-3);
  EXPECT_NEAR(before.told.left.parameters().fx_px, rig.cameras().left.parameters().fx_px, 1.0);
}

TEST(CalibrationChoiceTest, BoardsArePhotographedWithNoiseEvenWhereTrialsAreNot) {
  StereoRigOptions options;
  const StereoRig noisy(options, RandomStream(1));
  options.sensor.noise = false;
  options.sensor.fixed_pattern = false;
  const StereoRig noiseless(options, RandomStream(1));
  const CalibrationChoice boards{.source = CalibrationSource::kBoards, .boards = 5};
  EXPECT_EQ(Told(noisy, boards, 3), Told(noiseless, boards, 3));
}

TEST(BoardCalibrationTest, ContentTellsWhateverTheResultDependsOn) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  const BoardSessionOptions session;
  const std::string content = ContentOf(rig, session, RandomStream(2));
  EXPECT_EQ(content,
            ContentOf(StereoRig(SmallImages(), RandomStream(1)), session, RandomStream(2)));
  EXPECT_NE(content, ContentOf(rig, session, RandomStream(3)));
  EXPECT_NE(content,
            ContentOf(StereoRig(SmallImages(), RandomStream(7)), session, RandomStream(2)));
  BoardSessionOptions fewer = session;
  fewer.views = 19;
  EXPECT_NE(content, ContentOf(rig, fewer, RandomStream(2)));
  StereoRigOptions darker = SmallImages();
  darker.lens.f_number = 4.0;
  EXPECT_NE(content, ContentOf(StereoRig(darker, RandomStream(1)), session, RandomStream(2)));
}

}  // namespace
}  // namespace fenestra
