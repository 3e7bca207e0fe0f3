#include "sim/motion/rig_pose.h"

#include <gtest/gtest.h>

#include "core/geometry/pose.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

TEST(ViewpointTest, StraightInFrontTheRigLooksAlongMinusZWithALevelHorizon) {
  const Pose X_WB = RigPose({.distance_m = 3.0}, Pose());
  EXPECT_LT((X_WB.translation() - Vector3d(0, 0, 3)).norm(), 1e-15);
  EXPECT_LT((X_WB.rotation().col(0) - Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((X_WB.rotation().col(1) - Vector3d(0, -1, 0)).norm(), 1e-15);
  EXPECT_LT((X_WB.rotation().col(2) - Vector3d(0, 0, -1)).norm(), 1e-15);
}

TEST(ViewpointTest, FromEveryPointOfTheSphereTheCentroidIsOnTheAxisAtTheDistance) {
  const Pose X_WO(RotationFromVector({0.2, -0.4, 0.1}), {5.0, 1.0, -2.0});
  for (double azimuth = -170; azimuth < 180; azimuth += 35) {
    for (double elevation = -90; elevation <= 90; elevation += 30) {
      const Pose X_WB = RigPose({.distance_m = 2.5,
                                 .azimuth_rad = azimuth * kDegree,
                                 .elevation_rad = elevation * kDegree,
                                 .roll_rad = 0.3},
                                X_WO);
      const Vector3d p_BO = X_WB.inverse() * X_WO.translation();
      EXPECT_LT((p_BO - Vector3d(0, 0, 2.5)).norm(), 1e-14) << azimuth << " " << elevation;
    }
  }
}

TEST(ViewpointTest, PositiveAzimuthIsToTheViewersRightAndElevationUp) {
  const Vector3d p_WB =
      RigPose({.distance_m = 2.0, .azimuth_rad = 30 * kDegree, .elevation_rad = 20 * kDegree},
              Pose())
          .translation();
  EXPECT_NEAR(p_WB.x(), 2.0 * std::sin(30 * kDegree) * std::cos(20 * kDegree), 1e-15);
  EXPECT_NEAR(p_WB.y(), 2.0 * std::sin(20 * kDegree), 1e-15);
}

TEST(ViewpointTest, YawPitchAndRollMoveTheImageTheOtherWay) {
  const auto centroid = [](const Viewpoint& viewpoint) {
    return Vector3d(RigPose(viewpoint, Pose()).inverse() * Vector3d::Zero());
  };
  // Looking to the right puts the centroid to the left; looking up puts it down (+y).
  EXPECT_LT(centroid({.yaw_rad = 0.1}).x(), 0.0);
  EXPECT_GT(centroid({.pitch_rad = 0.1}).y(), 0.0);
  // Turning the camera clockwise turns what is above the centre to the left.
  const Pose X_WB = RigPose({.roll_rad = 0.1}, Pose());
  EXPECT_LT((X_WB.inverse() * Vector3d(0, 1, 0)).x(), 0.0);
}

}  // namespace
}  // namespace fenestra
