#include "vision/rgbd/plane/plane_seed.h"

#include <gtest/gtest.h>

#include "tests/vision/rgbd/synthetic_kinect.h"
#include "vision/rgbd/plane/depth_around_frame.h"
#include "vision/rgbd/plane/frame_planes.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

// Where sight from the origin to a point meets the plane z_O = 0 of a frame.
Vector3d OnFront(const Vector3d& p_LQ, const FrameRectangle& frame) {
  const Vector3d normal = frame.R_LO.col(2);
  return normal.dot(frame.p_LO) / normal.dot(p_LQ) * p_LQ;
}

TEST(PlaneSeedTest, SidesThatARevealHidesAreMovedToTheEdgeOfTheWall) {
  constexpr double kSetback_m = 0.1;
  for (const double azimuth_rad : {0.0, 0.5, -0.7}) {
    const Pose X_LO = testing::PoseOfWindow({.distance_m = 2.0, .azimuth_rad = azimuth_rad});
    FrameRectangle truth{.R_LO = X_LO.rotation(), .p_LO = X_LO.translation()};
    truth.width_m = 1.0;
    truth.height_m = 0.8;
    // The camera stands to the right or left of the opening, or before it; never above.
    const double camera_x_m = -X_LO.rotation().col(0).dot(X_LO.translation());
    if (camera_x_m > 0.5) truth.outer_relief_m[1] = kSetback_m;
    if (camera_x_m < -0.5) truth.outer_relief_m[3] = kSetback_m;
    EXPECT_EQ(std::abs(camera_x_m) > 0.5, azimuth_rad != 0.0);
    // Corners as the middles of the sides have them, all seen as if in the front's plane.
    std::array<Vector3d, 4> sides;
    for (const Side side : kAllSides) {
      sides[static_cast<size_t>(side)] = OnFront(truth.PointOn(side, Border::kOuter, 0.5), truth);
    }
    FrameRectangle seen{.R_LO = truth.R_LO};
    const Vector3d across = sides[1] - sides[3];
    const Vector3d up = sides[0] - sides[2];
    seen.width_m = std::abs(across.dot(truth.R_LO.col(0)));
    seen.height_m = std::abs(up.dot(truth.R_LO.col(1)));
    seen.p_LO = truth.p_LO +
                truth.R_LO.col(0) * truth.R_LO.col(0).dot(0.5 * (sides[1] + sides[3]) - truth.p_LO);
    const FrameRectangle moved = WithHiddenSides(seen, Vector3d::Zero(), kSetback_m);
    EXPECT_LT((moved.p_LO - truth.p_LO).norm(), 1e-12);
    EXPECT_NEAR(moved.width_m, truth.width_m, 1e-12);
    EXPECT_NEAR(moved.height_m, truth.height_m, 1e-12);
    EXPECT_EQ(moved.outer_relief_m, truth.outer_relief_m);
  }
}

TEST(PlaneSeedTest, CornersOnAPlaneProjectBackToTheirPixels) {
  const RgbdCalibration calibration = testing::KinectCalibration();
  const Pose X_DO = testing::PoseOfWindow({.distance_m = 2.0, .azimuth_rad = 0.5});
  const Vector3d normal = X_DO.rotation().col(2);
  const Vector3d m = normal / normal.dot(X_DO.translation());
  const Quadrilateral corners = {Eigen::Vector2d(200, 100), {400, 120}, {410, 300}, {190, 290}};
  const auto p_DV = CornersOnPlane(corners, calibration.color, calibration.X_KD, m, 0.1);
  ASSERT_TRUE(p_DV);
  for (size_t i = 0; i < 4; ++i) {
    const auto pixel = calibration.color.Project(calibration.X_KD * (*p_DV)[i]);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - corners[i]).norm(), 1e-9);
    EXPECT_NEAR((X_DO.inverse() * (*p_DV)[i]).z(), -0.1, 1e-12);
  }
}

}  // namespace
}  // namespace fenestra
