#include "vision/rgbd/plane/depth_plane.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Vector3d;

constexpr double kFocal_px = 570.0;
constexpr int kPixelStep = 8;  // Columns and rows that are read.

// Windows of one point, so that points are independent.
const DepthNoise kNoise{.sigma = 0.002,
                        .step = 0.0,
                        .window_px = kPixelStep,
                        .window_points = 1.0,
                        .window_rad = 0.0,
                        .image = {640, 480},
                        .farthest = 0.0};

Vector3d RayOf(const cv::Point& pixel) {
  return {(pixel.x - 319.5) / kFocal_px, (pixel.y - 239.5) / kFocal_px, 1.0};
}

// 4800 points of a plane.
std::vector<DepthPoint> PointsOn(const Vector3d& m, double noise, const RandomStream& stream) {
  std::vector<DepthPoint> points;
  uint64_t next = 0;
  for (int v = kPixelStep / 2; v < 480; v += kPixelStep) {
    for (int u = kPixelStep / 2; u < 640; u += kPixelStep) {
      const Vector3d ray_D = RayOf({u, v});
      const double inverse_depth = m.dot(ray_D) + noise * stream.Normal(next++);
      points.push_back({.pixel = {u, v},
                        .ray_D = ray_D,
                        .inverse_depth = inverse_depth,
                        .seen_px = {static_cast<float>(u), static_cast<float>(v)}});
    }
  }
  return points;
}

// A wall 3 m away, seen from its left and from below.
const Vector3d kWall(0.08, -0.03, 1.0 / 3.0);

TEST(DepthPlane, OfExactPointsIsExact) {
  const auto found =
      FindDepthPlane(PointsOn(kWall, 0.0, RandomStream(1)), kNoise, 100, RandomStream(2));
  ASSERT_TRUE(found.has_value());
  EXPECT_LT((found->m - kWall).norm(), 1e-12);
  EXPECT_EQ(found->inliers, 4800);
  const auto measured = MeasureDepthPlane(PointsOn(kWall, 0.0, RandomStream(1)),
                                          kWall + Vector3d(0.001, 0.0, -0.001), kNoise, 100);
  ASSERT_TRUE(measured.has_value());
  EXPECT_LT((measured->m - kWall).norm(), 1e-12);
}

TEST(DepthPlane, AThirdOfOutliersChangesNothing) {
  std::vector<DepthPoint> points = PointsOn(kWall, kNoise.sigma, RandomStream(3));
  // At random places, since the search looks at every twelfth point.
  const RandomStream clutter(4);
  std::vector<bool> is_clutter;
  for (size_t i = 0; i < points.size(); ++i) {
    is_clutter.push_back(clutter.Uniform(2 * i) < 1.0 / 3.0);
    if (is_clutter[i]) points[i].inverse_depth = 0.5 + 0.5 * clutter.Uniform(2 * i + 1);
  }
  const auto found = FindDepthPlane(points, kNoise, 100, RandomStream(5));
  ASSERT_TRUE(found.has_value());
  for (size_t i = 0; i < points.size(); ++i)
    EXPECT_FALSE(is_clutter[i] && found->is_inlier[i]) << i;
  // Some 3200 points are left, of which 3.5 standard deviations leave out one in 2000: more than
  // eight with a probability of 3e-5.
  EXPECT_NEAR(found->inliers, std::count(is_clutter.begin(), is_clutter.end(), false), 8);
  const Vector3d deviation = found->information.inverse().diagonal().cwiseSqrt();
  for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(found->m[i] - kWall[i]), 4.0 * deviation[i]) << i;
  EXPECT_NEAR(found->sigma, kNoise.sigma, 0.05 * kNoise.sigma);
}

TEST(DepthPlane, InformationIsHonest) {
  // The sum of the normalised squared errors of 200 planes follows χ² with 600 degrees of freedom;
  // two-sided, with a false-alarm rate of 1 %. Blocks scatter the variance by some per cent more.
  constexpr int kPlanes = 200;
  double found_sum = 0.0;
  double measured_sum = 0.0;
  for (uint64_t i = 0; i < kPlanes; ++i) {
    const auto points = PointsOn(kWall, kNoise.sigma, RandomStream(6).Child("plane", i));
    const auto found = FindDepthPlane(points, kNoise, 100, RandomStream(7));
    const auto measured = MeasureDepthPlane(points, kWall, kNoise, 100);
    ASSERT_TRUE(found && measured);
    found_sum += (found->m - kWall).dot(found->information * (found->m - kWall));
    measured_sum += (measured->m - kWall).dot(measured->information * (measured->m - kWall));
  }
  const boost::math::chi_squared law(3.0 * kPlanes);
  for (const double sum : {found_sum, measured_sum}) {
    EXPECT_GT(sum, 0.95 * quantile(law, 0.005));
    EXPECT_LT(sum, 1.05 * quantile(law, 0.995));
    // The twins: information halved, and doubled.
    EXPECT_LT(0.5 * sum, 0.95 * quantile(law, 0.005));
    EXPECT_GT(2.0 * sum, 1.05 * quantile(law, 0.995));
  }
}

TEST(DepthPlane, PointsThatShareAWindowCountOnce) {
  DepthNoise shared = kNoise;
  shared.window_points = 4.0;
  const auto points = PointsOn(kWall, kNoise.sigma, RandomStream(8));
  const auto apart = FindDepthPlane(points, kNoise, 100, RandomStream(9));
  const auto together = FindDepthPlane(points, shared, 100, RandomStream(9));
  ASSERT_TRUE(apart && together);
  EXPECT_LT((apart->information - 4.0 * together->information).norm(),
            1e-6 * apart->information.norm());
}

// A step of one standard deviation hides in single points and shows in the means of blocks.
TEST(DepthPlane, ALowStepIsLeftOutByItsBlocks) {
  DepthNoise noise = kNoise;
  noise.window_px = 16.0;
  noise.window_points = 4.0;
  std::vector<DepthPoint> points = PointsOn(kWall, kNoise.sigma, RandomStream(10));
  for (DepthPoint& point : points) {
    if (point.pixel.x < 140 && point.pixel.y < 200) point.inverse_depth += 1.5 * kNoise.sigma;
  }
  const auto measured = MeasureDepthPlane(points, kWall, noise, 100);
  ASSERT_TRUE(measured.has_value());
  int of_step = 0;
  int kept = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].pixel.x >= 112 || points[i].pixel.y >= 168) continue;
    ++of_step;
    kept += measured->is_inlier[i];
  }
  EXPECT_LT(kept, of_step / 2);
  EXPECT_GT(measured->inliers, 4000);
}

TEST(DepthPlane, QuantisationIsCommonToPointsAtOneDepth) {
  // A wall that faces the camera squarely: all its points are rounded alike, and no number of them
  // tells where between two steps it is.
  DepthNoise coarse = kNoise;
  coarse.step = 0.004;
  const Vector3d facing(0.0, 0.0, 1.0 / 3.0);
  std::vector<DepthPoint> points = PointsOn(facing, 0.0, RandomStream(1));
  for (DepthPoint& point : points) {
    point.inverse_depth = coarse.step * std::round(point.inverse_depth / coarse.step);
  }
  const auto measured = MeasureDepthPlane(points, facing, coarse, 100);
  ASSERT_TRUE(measured.has_value());
  const double sigma = measured->RelativeSigmaAt({0.0, 0.0, 3.0}) / 3.0;
  // The first term of a saw-tooth of amplitude q/2 has the root mean square q/(π√2).
  EXPECT_NEAR(sigma, coarse.step / (M_PI * std::sqrt(2.0)), 0.1 * coarse.step);
  EXPECT_LT(std::abs(measured->m.z() - facing.z()), 2.5 * sigma);
}

TEST(DepthPlane, BrightNearSidesOfWindowsAreTakenOff) {
  DepthNoise wide = kNoise;
  wide.window_rad = 0.05;
  const auto points = PointsOn(kWall, 0.0, RandomStream(1));
  const auto measured = MeasureDepthPlane(points, kWall, wide, 100);
  ASSERT_TRUE(measured.has_value());
  // The image's middle is the optical axis, but for half a pixel that the grid is off.
  const double variance = kWall.head<2>().squaredNorm() * 0.05 * 0.05 / 12.0;
  const double too_near = 2.0 * variance / (kWall.z() * kWall.z());
  EXPECT_NEAR((kWall - measured->m).norm() / kWall.norm(), too_near, 0.01 * too_near);
}

TEST(DepthPlane, HalfAPlaneAtTheSensorsEndIsNotBentTowardsIt) {
  // Where noise lifts a return over the largest depth it is lost, and the nearer ones are left.
  DepthNoise ending = kNoise;
  const Vector3d slanted(0.15, 0.0, 0.25);
  ending.farthest = 0.22;
  std::vector<DepthPoint> seen;
  for (const DepthPoint& point : PointsOn(slanted, 3.0 * kNoise.sigma, RandomStream(11))) {
    if (point.inverse_depth > ending.farthest) seen.push_back(point);
  }
  const auto careful = MeasureDepthPlane(seen, slanted, ending, 100);
  const auto careless = MeasureDepthPlane(seen, slanted, kNoise, 100);
  ASSERT_TRUE(careful && careless);
  EXPECT_LT((careful->m - slanted).norm(), (careless->m - slanted).norm());
}

TEST(DepthPlane, DistanceIsAlongTheNormalTowardsTheCamera) {
  auto points = PointsOn(kWall, 0.0, RandomStream(1));
  const auto found = FindDepthPlane(points, kNoise, 100, RandomStream(2));
  ASSERT_TRUE(found.has_value());
  DepthPoint point = points[1234];
  EXPECT_NEAR(found->Distance(point), 0.0, 1e-9);
  const Vector3d p_D = point.ray_D / point.inverse_depth;
  const Vector3d moved = p_D - 0.2 * kWall.normalized();
  point.ray_D = moved / moved.z();
  point.inverse_depth = 1.0 / moved.z();
  EXPECT_NEAR(found->Distance(point), 0.2, 1e-9);
}

TEST(DepthPlane, FewPointsOrALineOfThemFixNone) {
  const auto points = PointsOn(kWall, kNoise.sigma, RandomStream(12));
  const std::vector<DepthPoint> few(points.begin(), points.begin() + 50);
  EXPECT_FALSE(FindDepthPlane(few, kNoise, 100, RandomStream(1)));
  // One row of pixels.
  const std::vector<DepthPoint> row(points.begin(), points.begin() + 80);
  EXPECT_FALSE(FindDepthPlane(row, kNoise, 10, RandomStream(1)));
  EXPECT_FALSE(MeasureDepthPlane(row, kWall, kNoise, 10));
}

}  // namespace
}  // namespace fenestra
