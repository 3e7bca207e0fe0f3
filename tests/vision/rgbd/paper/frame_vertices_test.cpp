#include "vision/rgbd/paper/frame_vertices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random/random_stream.h"
#include "vision/rgbd/paper/cloud_shape.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::UnorderedElementsAre;

TEST(LargestQuadrilateral, OfAFramesKeyPointsIsTheOuterOne) {
  const std::vector<Vector2d> points = {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9},  // Inner.
                                        {0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0},  // Outer.
                                        {0.5, 0.0}, {0.2, 0.05}};
  const auto chosen = LargestQuadrilateral(points);
  ASSERT_TRUE(chosen);
  EXPECT_THAT(*chosen, UnorderedElementsAre(4, 5, 6, 7));
}

TEST(LargestQuadrilateral, IsNoSmallerThanAnyOther) {
  const RandomStream uniforms(11);
  std::vector<Vector2d> points;
  for (uint64_t i = 0; i < 12; ++i) {
    points.emplace_back(uniforms.Uniform(2 * i), uniforms.Uniform(2 * i + 1));
  }
  const auto chosen = LargestQuadrilateral(points);
  ASSERT_TRUE(chosen);
  const auto area = [&points](const std::array<int, 4>& corners) {
    std::vector<Vector2d> outline;
    for (const int i : corners) outline.push_back(points[static_cast<size_t>(i)]);
    return SignedArea(outline);
  };
  const double largest = area(*chosen);
  EXPECT_GT(largest, 0.0);
  for (int a = 0; a < 12; ++a) {
    for (int b = 0; b < 12; ++b) {
      for (int c = 0; c < 12; ++c) {
        for (int d = 0; d < 12; ++d) EXPECT_LE(area({a, b, c, d}), largest + 1e-15);
      }
    }
  }
}

TEST(LargestQuadrilateral, NeedsFourPointsInConvexPosition) {
  EXPECT_FALSE(LargestQuadrilateral({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}));
  EXPECT_FALSE(LargestQuadrilateral({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.2, 0.2}}));
  EXPECT_FALSE(LargestQuadrilateral({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}}));
}

TEST(OrderedAsSeen, IsTopLeftTopRightBottomRightBottomLeftForEveryLabelling) {
  const FourVertices expected = {
      Vector3d(-0.5, -0.4, 2.0), {0.5, -0.5, 2.2}, {0.6, 0.5, 2.1}, {-0.4, 0.5, 1.9}};
  FourVertices given = expected;
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(OrderedAsSeen(given), expected) << "labelling " << i;
    std::rotate(given.begin(), given.begin() + 1, given.end());
    if (i == 3) std::reverse(given.begin(), given.end());
  }
}

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
