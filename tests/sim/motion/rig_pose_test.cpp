#include "sim/motion/rig_pose.h"

#include <gtest/gtest.h>

#include <numbers>

namespace fenestra {
namespace {

TEST(RigMotionTest, VelocityIsAlongTheRigsOwnAxes) {
  const Pose X_WB(RotationFromVector({0.0, std::numbers::pi / 2.0, 0.0}), {1.0, 2.0, 3.0});
  const Pose later = PoseAt(X_WB, {.velocity_B = {0.0, 0.0, 2.0}}, 0.5);
  // +z of a rig that is turned to the right by a quarter is the world's +x.
  EXPECT_LT((later.translation() - Eigen::Vector3d(2.0, 2.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((later.rotation() - X_WB.rotation()).norm(), 1e-12);
}

TEST(RigMotionTest, AScrewMotionIsTheSumOfItsParts) {
  const RigMotion motion{.velocity_B = {0.3, -0.2, 1.0}, .angular_velocity_B = {0.5, 1.5, -0.7}};
  const Pose X_WB(RotationFromVector({0.1, 0.2, 0.3}), {1.0, 2.0, 3.0});
  const Pose once = PoseAt(X_WB, motion, 0.8);
  const Pose twice = PoseAt(PoseAt(X_WB, motion, 0.5), motion, 0.3);
  EXPECT_LT((once.translation() - twice.translation()).norm(), 1e-12);
  EXPECT_LT((once.rotation() - twice.rotation()).norm(), 1e-12);
  const Pose back = PoseAt(once, motion, -0.8);
  EXPECT_LT((back.translation() - X_WB.translation()).norm(), 1e-12);
}

TEST(RigMotionTest, ACircleIsClosed) {
  // Forward at 1 m/s while turning once in 4 s: half a circle of circumference 4 m after 2 s.
  const RigMotion motion{.velocity_B = {0.0, 0.0, 1.0},
                         .angular_velocity_B = {0.0, std::numbers::pi / 2.0, 0.0}};
  const Pose half = PoseAt(Pose(), motion, 2.0);
  EXPECT_LT((half.translation() - Eigen::Vector3d(4.0 / std::numbers::pi, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_LT((PoseAt(Pose(), motion, 4.0).translation()).norm(), 1e-9);
}

TEST(RigMotionTest, ImageMotionBoundsThatOfAnyPoint) {
  const RigMotion motion{.velocity_B = {1.0, -2.0, 3.0}, .angular_velocity_B = {0.4, -0.3, 0.5}};
  constexpr double kTime_s = 1e-4;
  constexpr double kFocal_px = 600.0;
  const double bound = ImageMotion(motion, kTime_s, kFocal_px, 0.8, 2.0);
  const Pose X_01 = PoseAt(Pose(), motion, kTime_s);
  for (double x = -0.56; x <= 0.56; x += 0.14) {
    for (double y = -0.56; y <= 0.56; y += 0.14) {
      const Eigen::Vector3d before = Eigen::Vector3d(x, y, 1.0) * 2.0;
      const Eigen::Vector3d after = X_01.inverse() * before;
      const double moved = kFocal_px * (after.hnormalized() - before.hnormalized()).norm();
      // Forward motion stretches by the radius, less than √(1 + r²); a first-order bound.
      EXPECT_LT(moved, 1.01 * bound);
    }
  }
}

}  // namespace
}  // namespace fenestra
