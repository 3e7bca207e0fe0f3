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

}  // namespace
}  // namespace fenestra
