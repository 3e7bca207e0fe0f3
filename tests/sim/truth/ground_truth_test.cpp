#include "sim/truth/ground_truth.h"

#include <gtest/gtest.h>

#include "sim/motion/rig_pose.h"

namespace fenestra {
namespace {

Scene SceneWithWindow(double side_m) {
  Scene scene;
  scene.target = TargetWindow{.X_WO = Pose(), .width_m = side_m, .height_m = side_m};
  return scene;
}

GroundTruth SeenFrom(const Viewpoint& viewpoint, double side_m = 1.0) {
  // 640 px at f = 320 px: at 2 m the image is 4 m wide and 3 m high.
  const Pose X_WC = RigPose(viewpoint, Pose());
  const PlacedCamera camera{CameraModel::Pinhole(640, 480, 320.0), X_WC};
  return MakeGroundTruth(SceneWithWindow(side_m), X_WC, {&camera, 1});
}

TEST(GroundTruthTest, CornersStandAroundTheCentroidInReadingOrder) {
  const GroundTruth truth = SeenFrom({.distance_m = 2.0});
  ASSERT_TRUE(truth.target);
  EXPECT_LT((truth.target->p_CO - Eigen::Vector3d(0, 0, 2)).norm(), 1e-15);
  EXPECT_LT((truth.target->p_CV[0] - Eigen::Vector3d(-0.5, -0.5, 2)).norm(), 1e-15);
  EXPECT_LT((truth.target->p_CV[1] - Eigen::Vector3d(0.5, -0.5, 2)).norm(), 1e-15);
  EXPECT_LT((truth.target->p_CV[2] - Eigen::Vector3d(0.5, 0.5, 2)).norm(), 1e-15);
  EXPECT_LT((truth.target->normal_C - Eigen::Vector3d(0, 0, -1)).norm(), 1e-15);
}

TEST(GroundTruthTest, InViewMeansAllCornersInTheImage) {
  EXPECT_TRUE(SeenFrom({.distance_m = 2.0}, 2.99).in_view);
  EXPECT_FALSE(SeenFrom({.distance_m = 2.0}, 3.01).in_view);  // 3.00 m fill the 480 rows.
  EXPECT_FALSE(SeenFrom({.distance_m = 2.0, .yaw_rad = 0.7}).in_view);
}

TEST(GroundTruthTest, FromBehindTheWallTheWindowIsNotInView) {
  EXPECT_FALSE(SeenFrom({.distance_m = 2.0, .azimuth_rad = 3.14159}).in_view);
}

TEST(GroundTruthTest, EveryCameraMustSeeIt) {
  const Pose X_WC = RigPose({.distance_m = 2.0}, Pose());
  const CameraModel camera = CameraModel::Pinhole(640, 480, 320.0);
  const std::array<PlacedCamera, 2> cameras = {
      PlacedCamera{camera, X_WC}, PlacedCamera{camera, X_WC * Pose::Translation({1.6, 0, 0})}};
  EXPECT_FALSE(MakeGroundTruth(SceneWithWindow(1.0), X_WC, cameras).in_view);
}

}  // namespace
}  // namespace fenestra
