#include "vision/rgbd/paper/cloud_shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;
using ::testing::ElementsAre;

std::vector<Vector2d> RandomPoints(int count) {
  const RandomStream uniforms(5);
  std::vector<Vector2d> points;
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<uint64_t>(2 * i);
    points.emplace_back(uniforms.Uniform(index), uniforms.Uniform(index + 1));
  }
  return points;
}

TEST(ConvexHull, GoesRoundASquareAndLeavesOutTheRest) {
  const std::vector<Vector2d> points = {{0.5, 0.5}, {1.0, 1.0}, {0.0, 0.0}, {0.5, 0.0},
                                        {0.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}};
  const std::vector<int> hull = ConvexHull(points);
  ASSERT_EQ(hull.size(), 4u);
  std::vector<Vector2d> corners;
  for (const int i : hull) corners.push_back(points[static_cast<size_t>(i)]);
  EXPECT_EQ(SignedArea(corners), 1.0);
}

TEST(ConvexHull, HoldsAllPointsOnItsLeft) {
  const std::vector<Vector2d> points = RandomPoints(200);
  const std::vector<int> hull = ConvexHull(points);
  for (size_t k = 0; k < hull.size(); ++k) {
    const Vector2d& a = points[static_cast<size_t>(hull[k])];
    const Vector2d& b = points[static_cast<size_t>(hull[(k + 1) % hull.size()])];
    for (const Vector2d& p : points) {
      EXPECT_GE(SignedArea({a, b, p}), -1e-15);  // Rounding of products below 1.
    }
  }
}

TEST(ConvexHull, OfFewOrCollinearPointsIsDegenerate) {
  EXPECT_TRUE(ConvexHull({}).empty());
  EXPECT_THAT(ConvexHull({{1.0, 2.0}}), ElementsAre(0));
  EXPECT_LT(ConvexHull({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}, {3.0, 3.0}}).size(), 3u);
  EXPECT_LT(ConvexHull({{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}).size(), 3u);
}

}  // namespace
}  // namespace fenestra
