#include "core/geometry/pose.h"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace fenestra {
namespace {

using Eigen::Vector3d;

const Pose kX_AB(RotationFromVector({0.3, -0.2, 0.9}), {1.0, -2.0, 3.0});
const Pose kX_BC(RotationFromVector({-1.1, 0.4, 0.1}), {0.5, 0.25, -4.0});

TEST(PoseTest, CompositionAppliesTheRightFactorFirst) {
  const Vector3d p_CQ(0.1, 0.2, 0.3);
  // A handful of roundings of numbers below 10.
  EXPECT_LT(((kX_AB * kX_BC) * p_CQ - kX_AB * (kX_BC * p_CQ)).norm(), 1e-14);
}

TEST(PoseTest, InverseUndoes) {
  const Vector3d p_BQ(0.1, 0.2, 0.3);
  EXPECT_LT((kX_AB.inverse() * (kX_AB * p_BQ) - p_BQ).norm(), 1e-14);
}

TEST(PoseTest, RotationVectorTurnsByItsLengthAboutItsDirection) {
  const Eigen::Matrix3d R = RotationFromVector({0.0, 0.0, std::numbers::pi / 2});
  EXPECT_LT((R * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-15);
}

TEST(PoseTest, RefusesWhatIsNoRigidTransform) {
  EXPECT_THROW(Pose(2.0 * Eigen::Matrix3d::Identity(), Vector3d::Zero()), std::logic_error);
  const Eigen::Matrix3d mirror = Vector3d(-1.0, 1.0, 1.0).asDiagonal();
  EXPECT_THROW(Pose(mirror, Vector3d::Zero()), std::logic_error);
  EXPECT_THROW(Pose::Translation({0.0, NAN, 0.0}), std::logic_error);
}

}  // namespace
}  // namespace fenestra
