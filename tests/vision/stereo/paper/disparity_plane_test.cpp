#include "vision/stereo/paper/disparity_plane.h"

#include <gtest/gtest.h>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

constexpr RectifiedCamera kPlaneCamera{
    .f_px = 666.7, .cx_px = 375.5, .cy_px = 239.5, .baseline_m = 0.35};

// Disparities of the plane n · p = h [m] at random pixels.
std::vector<DisparitySample> SeePlane(const Eigen::Vector3d& n, double h, int count) {
  const RandomStream stream(7);
  std::vector<DisparitySample> samples;
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<uint64_t>(2 * i);
    const float u = static_cast<float>(752.0 * stream.Uniform(index));
    const float v = static_cast<float>(480.0 * stream.Uniform(index + 1));
    const double depth_m = h / n.dot(kPlaneCamera.Ray({u, v}));
    samples.push_back({u, v, static_cast<float>(kPlaneCamera.DisparityFromDepth(depth_m))});
  }
  return samples;
}

TEST(DisparityPlane, PlaneOfTheWorldIsRecoveredExactly) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.1, 0.9).normalized();
  const auto fit = FitDisparityPlane(SeePlane(n, 3.0, 300), 0.75);
  ASSERT_TRUE(fit);
  // Disparities of about 80 px are rounded to floats: 80 · 2^-24 = 5e-6 px, or 6e-8 of the depth.
  EXPECT_LT((fit->plane.Normal(kPlaneCamera) + n).norm(), 1e-6);
  const auto p_FQ = fit->plane.PointAt({100.0, 200.0}, kPlaneCamera);
  ASSERT_TRUE(p_FQ);
  EXPECT_NEAR(n.dot(*p_FQ), 3.0, 1e-5);
  EXPECT_EQ(fit->inlier_share, 1.0);
}

TEST(DisparityPlane, AThirdOfOutliersChangesNothing) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.2, 0.1, 0.95).normalized();
  auto samples = SeePlane(n, 4.0, 300);
  // All to one side, as the doubles of a repeated structure are.
  for (size_t i = 0; i < samples.size(); i += 3) samples[i].disparity_px += 60.0f;
  const auto fit = FitDisparityPlane(samples, 0.75);
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->plane.Normal(kPlaneCamera) + n).norm(), 1e-6);
  EXPECT_NEAR(fit->inlier_share, 2.0 / 3.0, 1e-12);
}

TEST(DisparityPlane, PointsOnALineFixNoPlane) {
  std::vector<DisparitySample> samples;
  for (int i = 0; i < 50; ++i) samples.push_back({100.0f, 5.0f * static_cast<float>(i), 40.0f});
  EXPECT_FALSE(FitDisparityPlane(samples, 0.75));
  EXPECT_FALSE(FitDisparityPlane({}, 0.75));
}

TEST(DisparityPlane, BeyondItsHorizonThereIsNoPoint) {
  const DisparityPlane plane{.a = 0.1, .b = 0.0, .c = -10.0};
  EXPECT_FALSE(plane.PointAt({100.0, 0.0}, kPlaneCamera));
  EXPECT_TRUE(plane.PointAt({101.0, 0.0}, kPlaneCamera));
}

}  // namespace
}  // namespace fenestra
