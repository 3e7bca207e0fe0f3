#include "vision/rgbd/paper/cloud_shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::ElementsAre;

constexpr PlaneTolerance kPlaneTolerance{.fixed_m = 0.005, .per_z2 = 0.005};
const Vector3d kNormal = Vector3d(0.2, -0.1, -1.0).normalized();
constexpr double kOffset = -2.0;

// Points of the plane n · p = d in a square of 1 m, by uniforms of `random`.
std::vector<Vector3d> OnPlane(int count, const RandomStream& random) {
  std::vector<Vector3d> points;
  for (uint64_t i = 0; i < static_cast<uint64_t>(count); ++i) {
    const double x = random.Uniform(2 * i) - 0.5;
    const double y = random.Uniform(2 * i + 1) - 0.5;
    points.emplace_back(x, y, (kOffset - kNormal.x() * x - kNormal.y() * y) / kNormal.z());
  }
  return points;
}

TEST(DominantPlane, OfPlanarPointsIsExactAndFacesTheCamera) {
  const auto plane = DominantPlane(OnPlane(500, RandomStream(1)), kPlaneTolerance, RandomStream(2));
  ASSERT_TRUE(plane);
  EXPECT_LT((plane->normal_K - kNormal).norm(), 1e-12);
  EXPECT_NEAR(plane->offset_m, kOffset, 1e-12);
}

TEST(DominantPlane, IgnoresFortyPercentOfOutliers) {
  std::vector<Vector3d> points = OnPlane(600, RandomStream(1));
  const RandomStream random(3);
  for (uint64_t i = 0; i < 400; ++i) {  // All farther than 0.2 m behind the plane.
    const Vector3d p(random.Uniform(3 * i), random.Uniform(3 * i + 1),
                     3.0 + random.Uniform(3 * i + 2));
    points.push_back(p);
  }
  const auto plane = DominantPlane(points, kPlaneTolerance, RandomStream(2));
  ASSERT_TRUE(plane);
  EXPECT_LT((plane->normal_K - kNormal).norm(), 1e-12);
  EXPECT_NEAR(plane->offset_m, kOffset, 1e-12);
}

TEST(DominantPlane, ErrorOfItsDistanceFallsWithTheNumberOfPoints) {
  const double sigma_m = 0.006;  // The Kinect's at 2 m.
  std::vector<Vector3d> points = OnPlane(4000, RandomStream(1));
  const RandomStream noise(4);
  for (size_t i = 0; i < points.size(); ++i) points[i].z() += sigma_m * noise.Normal(i);
  const auto plane = DominantPlane(points, kPlaneTolerance, RandomStream(2));
  ASSERT_TRUE(plane);
  // The distance at the mean of N points has σ/√N = 0.1 mm; 5 σ are a false alarm of 6e-7.
  const Vector3d middle(0.0, 0.0, kOffset / kNormal.z());
  EXPECT_LT(std::abs(plane->SignedDistance(middle)), 5.0 * sigma_m / std::sqrt(4000.0));
}

TEST(DominantPlane, IsNotThereForTooFewOrCollinearPointsOrEdgeOn) {
  EXPECT_FALSE(DominantPlane({}, kPlaneTolerance, RandomStream(2)));
  EXPECT_FALSE(DominantPlane({{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}}, kPlaneTolerance, RandomStream(2)));
  std::vector<Vector3d> line;
  std::vector<Vector3d> edge_on;
  for (int i = 0; i < 20; ++i) {
    line.emplace_back(0.125 * i, 0.25 * i, 1.0 + 0.5 * i);
    edge_on.emplace_back(0.0, 0.125 * (i % 5), 1.0 + 0.25 * i);
  }
  EXPECT_FALSE(DominantPlane(line, {.fixed_m = 1e-6, .per_z2 = 0.0}, RandomStream(2)));
  EXPECT_FALSE(DominantPlane(edge_on, {.fixed_m = 1e-6, .per_z2 = 0.0}, RandomStream(2)));
}

TEST(PlaneCoordinates, AreIsometricAndRightDownAsSeen) {
  const Plane plane{.normal_K = kNormal, .offset_m = kOffset};
  const std::vector<Vector3d> points = OnPlane(3, RandomStream(9));
  for (const Vector3d& a : points) {
    for (const Vector3d& b : points) {
      EXPECT_NEAR((plane.Coordinates(a) - plane.Coordinates(b)).norm(), (a - b).norm(), 1e-14);
    }
  }
  const Vector3d here(0.0, 0.0, 2.0);
  const Plane facing{.normal_K = {0.0, 0.0, -1.0}, .offset_m = -2.0};
  EXPECT_EQ(facing.Coordinates(here + Vector3d(0.5, 0.25, 0.0)), Eigen::Vector2d(0.5, 0.25));
}

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
