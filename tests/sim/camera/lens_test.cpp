#include "sim/camera/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

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

Focus FourMillimetres() {
  return {.focal_length_m = 4e-3, .f_number = 2.8, .pixel_pitch_m = 6e-6, .distance_m = 3.0};
}

TEST(LensTest, WhatIsInFocusIsAPointAndWhatIsFarIsAsTheApertureSays) {
  const auto confusion_at = [](double z_m) {
    return static_cast<double>(CirclesOfConfusion(cv::Mat1f(5, 7, static_cast<float>(1.0 / z_m)),
                                                  FourMillimetres())(2, 3));
  };
  EXPECT_NEAR(confusion_at(3.0), 0.0, 1e-6);
  // An aperture A = f/N, seen from the image of a point that is δ behind the sensor, f + f²/z away:
  // A δ / (f + f²/z), which is of first order f²/N |1/z - 1/z_focus|.
  for (const double z_m : {0.5, 1.0, 1e6}) {
    const double f = 4e-3;
    const double image_m = 1.0 / (1.0 / f - 1.0 / z_m);
    const double sensor_m = 1.0 / (1.0 / f - 1.0 / 3.0);
    const double exact_px = f / 2.8 * std::abs(image_m - sensor_m) / image_m / 6e-6;
    EXPECT_NEAR(confusion_at(z_m) / exact_px, 1.0, 0.01) << z_m;
  }
}

TEST(LensTest, ATiltedSensorIsOutOfFocusOnBothSides) {
  Focus focus = FourMillimetres();
  focus.tilt_rad = {5e-3, 0.0};
  const cv::Mat1f confusion = CirclesOfConfusion(cv::Mat1f(101, 201, 1.0f / 3.0f), focus);
  EXPECT_NEAR(confusion(50, 100), 0.0, 1e-6);
  // 100 px from the middle the sensor is 100 · 5e-3 px before or behind the focus.
  for (const int u : {0, 200}) EXPECT_NEAR(confusion(10, u), 0.5 / 2.8, 1e-5);
  // A near point on one side is back in focus: f²/z against the tilt.
  const double needed_m = 100.0 * 6e-6 * 5e-3;
  const double inverse = 1.0 / 3.0 + needed_m / (4e-3 * 4e-3);
  const cv::Mat1f nearer =
      CirclesOfConfusion(cv::Mat1f(101, 201, static_cast<float>(inverse)), focus);
  EXPECT_NEAR(nearer(10, 0), 0.0, 1e-5);
  EXPECT_NEAR(nearer(10, 200), 1.0 / 2.8, 1e-5);
}

}  // namespace
}  // namespace fenestra
