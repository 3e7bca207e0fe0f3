#include "sim/camera/point_spread.h"

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

TEST(PointSpreadTest, AnEdgeIsGatheredAsTheIntegralSaysWhereverItStands) {
  // What is left is due to the quarters' own width: an edge between two of them stays as sharp as
  // one within a quarter. Whole pixels err more than twice as much.
  EXPECT_LT(WorstEdgeError(true), 0.023);
  EXPECT_GT(WorstEdgeError(false), 0.046);
}

TEST(PointSpreadTest, BlurGrowsFromTheCentreToTheCorners) {
  // A quadratic image u² shows the variance of the kernel that gathered each pixel: its value there
  // is u² + σ²(u, v) + 1/12, of the pixel's own width, for any kernel; for the kernels' 2-D sum as
  // well.
  const cv::Size size(101, 81);
  const QuarterImages squares =
      QuartersOf(size, [](double u) { return ((u - 50.0) * (u - 50.0) + 1.0 / 48.0) / 64.0; });
  // Everywhere a circle of confusion of 1.2 px, which adds 1.2²/16.
  const PointSpread spread{
      .centre_sigma_px = 0.4, .corner_sigma_px = 0.9, .confusion_px = cv::Mat1f(size, 1.2f)};
  const cv::Mat1f gathered = Gather(squares, spread);
  const double corner2 = 0.25 * (101.0 * 101.0 + 81.0 * 81.0);
  for (const cv::Point p : {cv::Point(50, 40), cv::Point(90, 40), cv::Point(50, 75),
                            cv::Point(10, 10), cv::Point(92, 72)}) {
    const double rho2 = ((p.x - 50) * (p.x - 50) + (p.y - 40) * (p.y - 40)) / corner2;
    const double lens = 0.16 + (0.81 - 0.16) * rho2 + 0.09;
    EXPECT_NEAR(VarianceAt(spread, size, Eigen::Vector2d(p.x, p.y)), lens, 1e-6);
    const double expected = lens + 1.0 / 12.0;
    const double found = 64.0 * static_cast<double>(gathered(p)) - (p.x - 50) * (p.x - 50);
    // The passes' variances are taken where each pass gathers, a pixel or two from p; squares of up
    // to 40 stand in single precision.
    EXPECT_NEAR(found, expected, 0.01) << p;
  }
}

TEST(PointSpreadTest, GatheringKeepsFlatImagesAndLight) {
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

TEST(PointSpreadTest, WithoutBlurAPixelIsTheMeanOfItsQuarters) {
  cv::Mat1f fine(20, 30);
  cv::randu(fine, 0.0f, 1.0f);
  const QuarterImages quarters = QuartersOf(fine);
  const cv::Mat1f gathered = Gather(quarters, {.centre_sigma_px = 0.0, .corner_sigma_px = 0.0});
  const cv::Mat1f mean = 0.25 * (quarters[0] + quarters[1] + quarters[2] + quarters[3]);
  EXPECT_LT(cv::norm(gathered, mean, cv::NORM_INF), 1e-6);
}

// Third central moments of where the rays of a pupil arrive, by a sum over the pupil.
struct ThirdMoments {
  double xxx = 0.0;
  double xxy = 0.0;
  double xyy = 0.0;
  double yyy = 0.0;
};
ThirdMoments OfComaRays(const Eigen::Vector2d& sagittal) {
  constexpr int kSteps = 400;
  const double length = sagittal.norm();
  if (length == 0.0) return {};
  const Eigen::Vector2d along = sagittal / length;
  const Eigen::Vector2d across(-along.y(), along.x());
  ThirdMoments moments;
  for (int i = 0; i < kSteps; ++i) {
    const double r2 = (i + 0.5) / kSteps;  // Equal areas.
    for (int j = 0; j < kSteps; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / kSteps;
      // The rays' centroid is S.
      const Eigen::Vector2d x = length * (r2 * (2.0 + std::cos(2.0 * phi)) - 1.0) * along +
                                length * r2 * std::sin(2.0 * phi) * across;
      constexpr double kShare = 1.0 / (kSteps * kSteps);
      moments.xxx += kShare * x.x() * x.x() * x.x();
      moments.xxy += kShare * x.x() * x.x() * x.y();
      moments.xyy += kShare * x.x() * x.y() * x.y();
      moments.yyy += kShare * x.y() * x.y() * x.y();
    }
  }
  return moments;
}

// The quarters of an image of (x, y), from the image's centre.
template <typename F>
QuarterImages QuartersOfPlane(cv::Size size, const F& f) {
  cv::Mat1f fine(2 * size.height, 2 * size.width);
  for (int v = 0; v < fine.rows; ++v) {
    for (int u = 0; u < fine.cols; ++u) {
      fine(v, u) = static_cast<float>(
          f(0.5 * u - 0.25 - 0.5 * (size.width - 1), 0.5 * v - 0.25 - 0.5 * (size.height - 1)));
    }
  }
  return QuartersOf(fine);
}

TEST(PointSpreadTest, ComaHasTheThirdMomentsOfItsRays) {
  // A cubic image changes by minus the kernel's third moment: <(x - ξ)³> = x³ + 3 x <ξ²> - <ξ³>.
  const cv::Size size(31, 21);
  const double half_diagonal = 0.5 * std::hypot(31.0, 21.0);
  const PointSpread even{.centre_sigma_px = 0.5, .corner_sigma_px = 0.5};
  PointSpread skewed = even;
  skewed.corner_coma_px = 1.5;
  skewed.coma_centre = {0.3, -0.2};
  const auto change = [&](const auto& cubic) {
    const QuarterImages image = QuartersOfPlane(size, cubic);
    return cv::Mat1f(Gather(image, skewed) - Gather(image, even));
  };
  constexpr double kOffset = 5000.0;  // Light is positive.
  const cv::Mat1f xxx = change([](double x, double) { return kOffset + x * x * x; });
  const cv::Mat1f xxy = change([](double x, double y) { return kOffset + x * x * y; });
  const cv::Mat1f xyy = change([](double x, double y) { return kOffset + x * y * y; });
  const cv::Mat1f yyy = change([](double, double y) { return kOffset + y * y * y; });
  for (const cv::Point p : {cv::Point(25, 3), cv::Point(4, 16), cv::Point(15, 10)}) {
    const Eigen::Vector2d place = Eigen::Vector2d(p.x - 15, p.y - 10) / half_diagonal;
    const ThirdMoments rays = OfComaRays(1.5 * (place - skewed.coma_centre));
    // Values of some thousands in single precision.
    constexpr double kRounding = 4e-3;
    EXPECT_NEAR(xxx(p), -rays.xxx, kRounding) << p;
    EXPECT_NEAR(xxy(p), -rays.xxy, kRounding) << p;
    EXPECT_NEAR(xyy(p), -rays.xyy, kRounding) << p;
    EXPECT_NEAR(yyy(p), -rays.yyy, kRounding) << p;
  }
}

TEST(PointSpreadTest, ComaMovesNeitherTheCentroidNorLight) {
  const cv::Size size(60, 60);
  const auto spot_of = [&](double coma_px) {
    cv::Mat1f fine(120, 120, 1.0f);
    fine(cv::Rect(90, 70, 2, 2)) = 11.0f;
    return cv::Mat1f(
        Gather(QuartersOf(fine),
               {.centre_sigma_px = 0.5, .corner_sigma_px = 0.5, .corner_coma_px = coma_px}) -
        1.0);
  };
  const auto centroid = [&](const cv::Mat1f& spot) {
    double u = 0.0;
    double v = 0.0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        u += x * static_cast<double>(spot(y, x));
        v += y * static_cast<double>(spot(y, x));
      }
    }
    return Eigen::Vector2d(u, v) / cv::sum(spot)[0];
  };
  const cv::Mat1f even = spot_of(0.0);
  const cv::Mat1f skewed = spot_of(1.5);
  // The weights differ by a per cent across the spot, in which coma grows.
  EXPECT_NEAR(cv::sum(skewed)[0] / cv::sum(even)[0], 1.0, 2e-3);
  EXPECT_LT((centroid(skewed) - centroid(even)).norm(), 0.02);
  // The twin: the tail of the same coma about its ray through the pupil's middle is S away.
  EXPECT_GT(cv::norm(skewed, even, cv::NORM_INF), 0.05);
}

TEST(PointSpreadTest, LightStaysPositiveBesideAnEdgeToBlack) {
  const QuarterImages edge =
      QuartersOf(cv::Size(41, 31), [](double u) { return u > 30.0 ? 1.0 : 0.0; });
  const cv::Mat1f seen =
      Gather(edge, {.centre_sigma_px = 0.4, .corner_sigma_px = 0.6, .corner_coma_px = 1.5});
  double least = 0.0;
  cv::minMaxLoc(seen, &least);
  EXPECT_GE(least, 0.0);
}

}  // namespace
}  // namespace fenestra
