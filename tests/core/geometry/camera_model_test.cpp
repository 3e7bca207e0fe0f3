#include "core/geometry/camera_model.h"

#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "core/random/random_stream.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

CameraModel WideCamera() {
  return CameraModel({.width_px = 752,
                      .height_px = 480,
                      .fx_px = 458.65,
                      .fy_px = 457.30,
                      .cx_px = 367.2,
                      .cy_px = 248.4,
                      .distortion = {.k1 = -0.2834, .k2 = 0.0740, .p1 = 1.9e-4, .p2 = 1.8e-5}});
}

TEST(CameraModelTest, ProjectionOfAPinholeIsFocalLengthTimesSlope) {
  const CameraModel camera = CameraModel::Pinhole(640, 480, 500.0);
  const auto pixel = camera.Project({0.2, -0.1, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_DOUBLE_EQ(pixel->x(), 319.5 + 50.0);
  EXPECT_DOUBLE_EQ(pixel->y(), 239.5 - 25.0);
}

TEST(CameraModelTest, UnprojectionInvertsProjectionOverTheImage) {
  const CameraModel camera = WideCamera();
  for (int v = 0; v < camera.height_px(); v += 17) {
    for (int u = 0; u < camera.width_px(); u += 13) {
      const auto ray = camera.UnprojectRay({u, v});
      ASSERT_TRUE(ray);
      const auto pixel = camera.Project(*ray);
      ASSERT_TRUE(pixel);
      // UnprojectRay promises 1e-12 of normalised coordinates, times f = 459 px.
      EXPECT_LT((*pixel - Vector2d(u, v)).norm(), 1e-9);
    }
  }
}

TEST(CameraModelTest, ProjectionInvertsUnprojectionOverTheWholeValidDomain) {
  const CameraModel camera = WideCamera();
  const RandomStream stream(1);
  for (uint64_t i = 0; i < 2000; ++i) {
    const double r = camera.max_radius() * 0.999 * std::sqrt(stream.Uniform(2 * i));
    const double angle = 6.283185307179586 * stream.Uniform(2 * i + 1);
    const Vector3d ray(r * std::cos(angle), r * std::sin(angle), 1.0);
    const auto pixel = camera.Project(ray);
    ASSERT_TRUE(pixel);
    const auto back = camera.UnprojectRay(*pixel);
    ASSERT_TRUE(back);
    // Near the border of the domain the slope may be as small as 0.01.
    EXPECT_LT((*back - ray).norm(), 1e-9);
  }
}

TEST(CameraModelTest, AGuessChangesARayByRoundingOnlyHoweverPoorItIs) {
  const CameraModel camera = WideCamera();
  const RandomStream stream(2);
  for (uint64_t i = 0; i < 2000; ++i) {
    const Vector2d pixel(751.0 * stream.Uniform(4 * i), 479.0 * stream.Uniform(4 * i + 1));
    const Vector3d ray = *camera.UnprojectRay(pixel);
    const Vector2d direction(stream.Normal(4 * i + 2), stream.Normal(4 * i + 3));
    for (const double off : {0.0, 1e-7, 1e-4, 0.1, 10.0, 1e300}) {
      const auto guessed = camera.UnprojectRay(pixel, ray.head<2>() + off * direction);
      ASSERT_TRUE(guessed);
      // 1e-13 in the distorted image, whose slope is at least 0.6 inside this one.
      EXPECT_LT((*guessed - ray).norm(), 2e-13);
    }
  }
  EXPECT_FALSE(camera.UnprojectRay({1e7, 0.0}, {0.1, 0.1}));
}

TEST(CameraModelTest, OutsideTheValidDomainThereIsNoPixelAndNoRay) {
  const CameraModel camera = WideCamera();
  EXPECT_FALSE(camera.Project({1.02 * camera.max_radius(), 0.0, 1.0}));
  EXPECT_FALSE(camera.Project({0.0, 0.0, -1.0}));
  EXPECT_FALSE(camera.Project({0.0, 0.0, 0.0}));
  EXPECT_FALSE(camera.UnprojectRay({1e7, 0.0}));
}

TEST(CameraModelTest, RadialGrowthIsPositiveUpToMaxRadiusAndNotBeyond) {
  // 1 - 3·0.3 r² = 0.01 at r = 1.04881.
  const CameraModel camera({.width_px = 100,
                            .height_px = 100,
                            .fx_px = 100,
                            .fy_px = 100,
                            .cx_px = 50,
                            .cy_px = 50,
                            .distortion = {.k1 = -0.3}});
  EXPECT_NEAR(camera.max_radius(), std::sqrt(0.99 / 0.9), 1e-12);
}

TEST(CameraModelTest, DerivativesAreThoseOfTheProjection) {
  const CameraModel camera = WideCamera();
  for (const Vector3d& p : {Vector3d(0.3, -0.2, 1.5), Vector3d(-0.7, 0.4, 1.2),
                            Vector3d(0.0, 0.0, 2.0), Vector3d(1.0, 0.9, 2.5)}) {
    const auto at = camera.Linearise(p);
    ASSERT_TRUE(at);
    EXPECT_EQ(at->pixel, *camera.Project(p));
    // Central differences: errors of h² times the third derivative and of 1e-16 f/h.
    constexpr double h = 1e-5;
    for (int i = 0; i < 3; ++i) {
      const Vector3d step = h * Vector3d::Unit(i);
      const Vector2d slope = (*camera.Project(p + step) - *camera.Project(p - step)) / (2.0 * h);
      EXPECT_LT((at->by_point.col(i) - slope).norm(), 1e-4) << i;
    }
    for (int i = 0; i < 9; ++i) {
      Eigen::Matrix<double, 9, 1> step = Eigen::Matrix<double, 9, 1>::Zero();
      step[i] = h;
      const auto moved = [&](double sign) {
        return *camera.WithParameters(camera.ParameterVector() + sign * step).Project(p);
      };
      const Vector2d slope = (moved(1.0) - moved(-1.0)) / (2.0 * h);
      EXPECT_LT((at->by_parameters.col(i) - slope).norm(), 1e-4) << i;
    }
  }
  EXPECT_FALSE(camera.Linearise({0.0, 0.0, -1.0}));
}

TEST(CameraModelTest, ScalingKeepsTheImageBorders) {
  const CameraModel camera = WideCamera();
  const CameraModel half = camera.Scaled(0.5);
  EXPECT_EQ(half.width_px(), 376);
  const Vector3d ray = *camera.UnprojectRay({-0.5, -0.5});
  EXPECT_LT((*half.Project(ray) - Vector2d(-0.5, -0.5)).norm(), 1e-9);
}

TEST(CameraModelTest, RefusesAbsurdParametersAllAtOnce) {
  try {
    CameraModel({.width_px = 0,
                 .height_px = 10,
                 .fx_px = -1.0,
                 .fy_px = NAN,
                 .cx_px = NAN,
                 .distortion = {}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3u);
  }
}

}  // namespace
}  // namespace fenestra
