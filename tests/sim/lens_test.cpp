#include "sim/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

// Sum and second central moments of an image [px²].
struct Moments {
  double sum = 0.0;
  double variance_u = 0.0;
  double variance_v = 0.0;
};

Moments MomentsAround(const cv::Mat1f& image, cv::Point centre) {
  Moments m;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const double value = image(v, u);
      m.sum += value;
      m.variance_u += value * (u - centre.x) * (u - centre.x);
      m.variance_v += value * (v - centre.y) * (v - centre.y);
    }
  }
  return m;
}

TEST(LensTest, BlurTapsHaveTheVarianceThatTheyAreAskedFor) {
  for (const double sigma_px : {0.2, 0.45, 0.7, 1.5, 4.0}) {
    const std::vector<float> taps = GaussianTaps(sigma_px);
    const int reach = static_cast<int>(taps.size()) / 2;
    double sum = 0.0;
    double variance = 0.0;
    for (int i = -reach; i <= reach; ++i) {
      sum += taps[static_cast<size_t>(i + reach)];
      variance += taps[static_cast<size_t>(i + reach)] * i * i;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_NEAR(variance, sigma_px * sigma_px, 1e-5 * sigma_px * sigma_px + 1e-6);
  }
}

TEST(LensTest, BlurGrowsFromTheCentreToTheCorners) {
  // A quadratic image u² shows the variance of the kernel that gathered each pixel: its blurred
  // value is u² + σ²(u, v), exactly for any kernel; for the kernels' 2-D sum as well.
  const cv::Size size(101, 81);
  cv::Mat1f squares(size);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      squares(v, u) = static_cast<float>((u - 50) * (u - 50)) / 64.0f;
    }
  }
  const PointSpread spread{.centre_sigma_px = 0.4, .corner_sigma_px = 0.9};
  const cv::Mat1f blurred = Blur(squares, spread);
  const double corner2 = 0.25 * (101.0 * 101.0 + 81.0 * 81.0);
  for (const cv::Point p : {cv::Point(50, 40), cv::Point(90, 40), cv::Point(50, 75),
                            cv::Point(10, 10), cv::Point(92, 72)}) {
    const double rho2 = ((p.x - 50) * (p.x - 50) + (p.y - 40) * (p.y - 40)) / corner2;
    const double expected = 0.16 + (0.81 - 0.16) * rho2;
    const double found = 64.0 * (blurred(p) - squares(p));
    // The passes' variances are taken where each pass gathers, a pixel or two from p; squares of up
    // to 40 stand in single precision.
    EXPECT_NEAR(found, expected, 0.01) << p;
  }
}

TEST(LensTest, BlurKeepsFlatImagesAndSymmetry) {
  const PointSpread spread{.centre_sigma_px = 0.4, .corner_sigma_px = 0.8};
  const cv::Mat1f flat = Blur(cv::Mat1f(40, 60, 7.0f), spread);
  double lowest = 0.0;
  double highest = 0.0;
  cv::minMaxLoc(flat, &lowest, &highest);
  EXPECT_NEAR(lowest, 7.0, 1e-5);
  EXPECT_NEAR(highest, 7.0, 1e-5);

  cv::Mat1f point = cv::Mat1f::zeros(41, 41);
  point(20, 20) = 1.0f;
  const Moments m = MomentsAround(Blur(point, spread), {20, 20});
  EXPECT_NEAR(m.sum, 1.0, 0.002);
  EXPECT_NEAR(m.variance_u, 0.16, 0.005);
  EXPECT_NEAR(m.variance_u, m.variance_v, 1e-5);
}

TEST(LensTest, NaturalVignettingIsTheFourthPowerOfTheCosine) {
  const CameraModel camera = CameraModel::Pinhole(201, 101, 100.0);
  const LensOptions lens{.corner_illumination = 1.0};
  const cv::Mat1f relative = RelativeIllumination(RayGrid(camera), lens);
  EXPECT_NEAR(relative(50, 100), 1.0, 1e-6);
  EXPECT_NEAR(relative(50, 200), std::pow(std::cos(std::numbers::pi / 4), 4), 1e-6);
}

TEST(LensTest, TheBarrelTakesItsShareInTheCorners) {
  const RayGrid rays(CameraModel::Pinhole(200, 100, 300.0));
  const cv::Mat1f open = RelativeIllumination(rays, {.corner_illumination = 1.0});
  const cv::Mat1f barrel = RelativeIllumination(rays, {.corner_illumination = 0.8});
  EXPECT_NEAR(barrel(50, 100) / open(50, 100), 1.0, 1e-4);
  // The corner pixel's centre is half a pixel inside the corner.
  EXPECT_NEAR(barrel(0, 0) / open(0, 0), 0.8, 0.003);
}

}  // namespace
}  // namespace fenestra
