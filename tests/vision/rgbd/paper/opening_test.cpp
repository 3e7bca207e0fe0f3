#include "vision/rgbd/paper/frame_vertices.h"

#include <gtest/gtest.h>

namespace fenestra {
namespace {

const CameraModel kCamera = CameraModel::Pinhole(320, 240, 300.0);
const Plane kWall{.normal_K = -Eigen::Vector3d::UnitZ(), .offset_m = -2.0};
const PlaneTolerance kTolerance{.fixed_m = 0.02, .per_z2 = 0.0};
// Of a square of 1 m that is faced from 2 m: 150 px.
const cv::Rect kOuter(85, 45, 150, 150);
const cv::Rect kInner(100, 60, 120, 120);

FourVertices Corners(double half_m) {
  return {Eigen::Vector3d(-half_m, -half_m, 2.0), Eigen::Vector3d(half_m, -half_m, 2.0),
          Eigen::Vector3d(half_m, half_m, 2.0), Eigen::Vector3d(-half_m, half_m, 2.0)};
}

DarkCloud Board() {
  cv::Mat1b mask(240, 320, uint8_t{0});
  mask(kOuter) = 255;
  return CloudOf(mask, cv::Mat1f(240, 320, 2.0f), kCamera);
}

DarkCloud Frame(float room_m) {
  cv::Mat1f depth_m(240, 320, 2.0f);
  depth_m(kInner) = room_m;
  cv::Mat1b mask(240, 320, uint8_t{0});
  mask(kOuter) = 255;
  return CloudOf(mask, depth_m, kCamera);
}

TEST(FilledShare, TellsABoardFromAFrame) {
  EXPECT_EQ(FilledShare(Board(), kCamera, kWall, kTolerance, Corners(0.45)), 1.0);
  // A dark room farther back, or without any depth, is an opening all the same.
  EXPECT_EQ(FilledShare(Frame(3.5f), kCamera, kWall, kTolerance, Corners(0.45)), 0.0);
  EXPECT_EQ(FilledShare(Frame(0.0f), kCamera, kWall, kTolerance, Corners(0.45)), 0.0);
}

TEST(SeenShare, IsThatOfTheLeastSeenSide) {
  DarkCloud frame = Frame(0.0f);
  EXPECT_EQ(SeenShare(frame, kCamera, kWall, kTolerance, Corners(0.45)), 1.0);
  // Nothing of the left side's lower half, whose places are (k + 1/2) / 32 of its length: 16 of 32.
  frame.depth_m(cv::Rect(80, 121, 40, 75)) = 0.0f;
  EXPECT_NEAR(SeenShare(frame, kCamera, kWall, kTolerance, Corners(0.45)), 0.5, 1.5 / 32.0);
  EXPECT_EQ(SeenShare(Frame(3.5f), kCamera, kWall, kTolerance, Corners(0.2)), 0.0);
}

}  // namespace
}  // namespace fenestra
