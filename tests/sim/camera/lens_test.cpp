#include "sim/camera/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

// The quarters of pixels as an image of twice the size tells them.
QuarterImages QuartersOf(const cv::Mat1f& fine) {
  QuarterImages quarters;
  for (int q = 0; q < 4; ++q) {
    cv::Mat1f quarter(fine.rows / 2, fine.cols / 2);
    for (int v = 0; v < quarter.rows; ++v) {
      for (int u = 0; u < quarter.cols; ++u) quarter(v, u) = fine(2 * v + q / 2, 2 * u + q % 2);
    }
    quarters[static_cast<size_t>(q)] = quarter;
  }
  return quarters;
}

// Mean of f over the quarters of pixels, to fourth order, for f of u alone [px].
template <typename F>
QuarterImages QuartersOf(cv::Size size, const F& f) {
  cv::Mat1f fine(2 * size.height, 2 * size.width);
  for (int x = 0; x < fine.cols; ++x) {
    fine.col(x).setTo(static_cast<float>(f(0.5 * x - 0.25)));
  }
  return QuartersOf(fine);
}

// By how much an edge as gathered departs at most from the closed form of its mean over pixels.
double WorstEdgeError(bool from_quarters) {
  constexpr double kSigma_px = 0.4;
  const auto integral = [](double x) {
    return 0.5 * x * (1.0 + std::erf(x / (kSigma_px * std::numbers::sqrt2))) +
           kSigma_px / std::sqrt(2.0 * std::numbers::pi) *
               std::exp(-0.5 * x * x / (kSigma_px * kSigma_px));
  };
  double worst = 0.0;
  for (int step = 0; step < 20; ++step) {
    const double edge = 20.0 + step / 20.0;
    QuarterImages quarters = QuartersOf(
        cv::Size(41, 3), [&](double u) { return std::clamp((u + 0.25 - edge) / 0.5, 0.0, 1.0); });
    if (!from_quarters) {
      const cv::Mat1f mean = 0.5 * (quarters[0] + quarters[1]);
      quarters.fill(mean);
    }
    const cv::Mat1f seen =
        Gather(quarters, {.centre_sigma_px = kSigma_px, .corner_sigma_px = kSigma_px});
    for (int u = 10; u < 31; ++u) {
      const double expected = integral(u + 0.5 - edge) - integral(u - 0.5 - edge);
      worst = std::max(worst, std::abs(static_cast<double>(seen(1, u)) - expected));
    }
  }
  return worst;
}

TEST(LensTest, AnEdgeIsGatheredAsTheIntegralSaysWhereverItStands) {
  // What is left is due to the quarters' own width: an edge between two of them stays as sharp as
  // one within a quarter. Whole pixels err more than twice as much.
  EXPECT_LT(WorstEdgeError(true), 0.023);
  EXPECT_GT(WorstEdgeError(false), 0.046);
}

TEST(LensTest, BlurGrowsFromTheCentreToTheCorners) {
  // A quadratic image u² shows the variance of the kernel that gathered each pixel: its value there
  // is u² + σ²(u, v) + 1/12, of the pixel's own width, for any kernel; for the kernels' 2-D sum as
  // well.
  const cv::Size size(101, 81);
  const QuarterImages squares =
      QuartersOf(size, [](double u) { return ((u - 50.0) * (u - 50.0) + 1.0 / 48.0) / 64.0; });
  const PointSpread spread{.centre_sigma_px = 0.4, .corner_sigma_px = 0.9};
  const cv::Mat1f gathered = Gather(squares, spread);
  const double corner2 = 0.25 * (101.0 * 101.0 + 81.0 * 81.0);
  for (const cv::Point p : {cv::Point(50, 40), cv::Point(90, 40), cv::Point(50, 75),
                            cv::Point(10, 10), cv::Point(92, 72)}) {
    const double rho2 = ((p.x - 50) * (p.x - 50) + (p.y - 40) * (p.y - 40)) / corner2;
    const double expected = 0.16 + (0.81 - 0.16) * rho2 + 1.0 / 12.0;
    const double found = 64.0 * static_cast<double>(gathered(p)) - (p.x - 50) * (p.x - 50);
    // The passes' variances are taken where each pass gathers, a pixel or two from p; squares of up
    // to 40 stand in single precision.
    EXPECT_NEAR(found, expected, 0.01) << p;
  }
}

TEST(LensTest, GatheringKeepsFlatImagesAndLight) {
  const PointSpread spread{.centre_sigma_px = 0.4, .corner_sigma_px = 0.8};
  const cv::Mat1f flat = Gather(QuartersOf(cv::Mat1f(80, 120, 7.0f)), spread);
  double lowest = 0.0;
  double highest = 0.0;
  cv::minMaxLoc(flat, &lowest, &highest);
  EXPECT_NEAR(lowest, 7.0, 1e-5);
  EXPECT_NEAR(highest, 7.0, 1e-5);

  cv::Mat1f point = cv::Mat1f::zeros(82, 82);
  point(cv::Rect(40, 40, 2, 2)) = 1.0f;
  const cv::Mat1f spot = Gather(QuartersOf(point), spread);
  EXPECT_NEAR(cv::sum(spot)[0], 1.0, 0.002);
  EXPECT_NEAR(spot(20, 19), spot(20, 21), 1e-6);
  EXPECT_NEAR(spot(20, 19), spot(19, 20), 1e-6);
}

TEST(LensTest, WithoutBlurAPixelIsTheMeanOfItsQuarters) {
  cv::Mat1f fine(20, 30);
  cv::randu(fine, 0.0f, 1.0f);
  const QuarterImages quarters = QuartersOf(fine);
  const cv::Mat1f gathered = Gather(quarters, {.centre_sigma_px = 0.0, .corner_sigma_px = 0.0});
  const cv::Mat1f mean = 0.25 * (quarters[0] + quarters[1] + quarters[2] + quarters[3]);
  EXPECT_LT(cv::norm(gathered, mean, cv::NORM_INF), 1e-6);
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

TEST(LensTest, ASmallBlackPatchGetsTheVeilingGlareIndexsShareOfTheField) {
  // ISO 9358's own measurement: a black patch, here 1 % of the picture, in a bright field.
  constexpr double kGlare = 0.04;
  cv::Mat1f field(100, 200, 50.0f);
  field(cv::Rect(90, 40, 20, 10)) = 0.0f;
  const cv::Mat1f veiled = WithVeilingGlare(field, kGlare);
  EXPECT_NEAR(veiled(45, 100) / 50.0, 0.99 * kGlare, 1e-6);
  // No light is lost or won: what is scattered is missing elsewhere.
  EXPECT_NEAR(cv::mean(veiled)[0], cv::mean(field)[0], 1e-4);
  // A uniform field hides the glare.
  const cv::Mat1f uniform(100, 200, 50.0f);
  EXPECT_LT(cv::norm(WithVeilingGlare(uniform, kGlare), uniform, cv::NORM_INF), 1e-4);
}

TEST(LensTest, EachColourIsVeiledByItsOwnMean) {
  cv::Mat3f image(10, 20, cv::Vec3f(0.0f, 0.0f, 0.0f));
  image.colRange(0, 10) = cv::Scalar(10.0, 20.0, 40.0);
  const cv::Mat3f veiled = WithVeilingGlare(image, 0.1);
  EXPECT_LT(cv::norm(veiled(5, 15) - cv::Vec3f(0.5f, 1.0f, 2.0f)), 1e-5);
}

}  // namespace
}  // namespace fenestra
