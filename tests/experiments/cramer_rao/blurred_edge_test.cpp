#include "experiments/cramer_rao/blurred_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

Eigen::Vector2d Normal(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

const std::array<double, 5> kAngles = {0.0, 1e-3, 0.3, std::numbers::pi / 4.0, 2.0};

// The mean of the blurred edge over the pixel, point by point.
double Gathered(double distance_px, double sigma_px, const Eigen::Vector2d& normal) {
  constexpr int kPoints = 64;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      const Eigen::Vector2d x((i + 0.5) / kPoints - 0.5, (j + 0.5) / kPoints - 0.5);
      sum += 0.5 * std::erfc(-(distance_px + normal.dot(x)) / (sigma_px * std::numbers::sqrt2));
    }
  }
  return sum / (kPoints * kPoints);
}

TEST(BlurredEdgeTest, IsTheMeanOverThePixelAtEveryAngle) {
  for (const double angle : kAngles) {
    for (const double sigma_px : {0.3, 0.5, 1.5}) {
      const BlurredEdge edge(sigma_px, Normal(angle));
      for (const double d : {-3.0, -0.7, -0.1, 0.0, 0.4, 1.2, 9.0}) {
        // The midpoint rule is off by h²/24 times the second derivative, at most 0.25/σ² = 2.7:
        // 3e-5; beyond its reach the edge is taken for sharp, which is 1e-5 off.
        EXPECT_NEAR(edge.At(d).share, Gathered(d, sigma_px, Normal(angle)), 5e-5)
            << angle << ' ' << sigma_px << ' ' << d;
      }
    }
  }
}

TEST(BlurredEdgeTest, ItsDerivativesAreThoseOfTheShare) {
  constexpr double kStep = 1e-4;
  for (const double angle : kAngles) {
    for (const double sigma_px : {0.1, 0.4, 1.5}) {
      const BlurredEdge edge(sigma_px, Normal(angle));
      const BlurredEdge wider(sigma_px + kStep, Normal(angle));
      const BlurredEdge narrower(sigma_px - kStep, Normal(angle));
      for (const double d : {-0.6, -0.2, 0.0, 0.3, 0.9}) {
        const double by_distance = (edge.At(d + kStep).share - edge.At(d - kStep).share) / 2e-4;
        const double by_sigma = (wider.At(d).share - narrower.At(d).share) / 2e-4;
        // Third derivatives are at most 1/σ³ = 1e3: step²/6 times that is 2e-6. For edges along
        // the pixels, rounding in a difference divided by 2e-4 px: 1e-15/2e-4/2e-4 = 3e-8.
        EXPECT_NEAR(edge.At(d).by_distance, by_distance, 4e-6) << angle << ' ' << d;
        EXPECT_NEAR(edge.At(d).by_sigma, by_sigma, 4e-6) << angle << ' ' << d;
      }
    }
  }
}

}  // namespace
}  // namespace fenestra
