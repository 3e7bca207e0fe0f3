#include "experiments/cramer_rao/border_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

// A sensor whose values say how many electrons there were, apart from noise of this deviation.
ImageSensorOptions SensorOfNoise(double deviation_e) {
  return {.saturation_e = 65535.0,
          .linear_range = 1.0,
          .dsnu_e = deviation_e,
          .prnu = 0.0,
          .adc_bits = 16,
          .output_bits = 16,
          .black_level_dn = 0.0,
          .noise = false};
}

// Information on an edge along the columns in one row of pixels, on average over where in a pixel
// it is; all else is known.
double MeanInformation(const BorderLevels& levels, const PixelNoise& noise, double lens_sigma_px) {
  constexpr int kPlaces = 16;
  const BlurredEdge edge(lens_sigma_px, {1.0, 0.0});
  double sum = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const BorderLine line{
        .outer = {.edge = edge, .place = 30.0 + (i + 0.5) / kPlaces, .slant = 1.0},
        .inner = {},
        .margin_px = 5.0,
        .first = 0,
        .last = 59};
    sum += InformationOf(line, levels, noise)(0, 0);
  }
  return sum / kPlaces;
}

// The lens' part of a blur in which the pixel's own area is contained.
double LensOf(double blur_sigma_px) {
  return std::sqrt(blur_sigma_px * blur_sigma_px - 1.0 / 12.0);
}

TEST(BorderProfileTest, AnEdgeInFixedNoiseHasItsClosedForm) {
  for (const double blur_px : {0.5, 0.6, 1.0}) {
    const PixelNoise noise = PixelNoise::Linear(SensorOfNoise(20.0), {});
    const double information =
        MeanInformation({.wall_e = 2000.0, .frame_e = 300.0}, noise, LensOf(blur_px));
    // The closed form takes pixel and lens together for a Gaussian: 2 % at 0.5 px.
    EXPECT_NEAR(1.0 / std::sqrt(information), EdgeBound_px(1700.0, 20.0, blur_px),
                0.02 * EdgeBound_px(1700.0, 20.0, blur_px));
  }
}

// A black frame (0.05) on a white wall (0.8) in 8 bits with 29 e of read noise, blurred by 0.6 px:
// published for the MT9V032 from its data sheet's figures, by how full the wall makes the pixels.
TEST(BorderProfileTest, AnEdgeOfTheStereoCameraHasItsPublishedBound) {
  ImageSensorOptions sensor{.saturation_e = 16000.0,
                            .linear_range = 1.0,
                            .read_noise_e = 29.0,
                            .adc_bits = 8,
                            .output_bits = 8,
                            .black_level_dn = 0.0,
                            .fixed_pattern = false};
  const PixelNoise noise = PixelNoise::Linear(sensor, {});
  for (const auto& [full, bound_px] :
       {std::pair{0.70, 0.011}, {0.35, 0.017}, {0.10, 0.043}, {0.03, 0.12}}) {
    const double wall_e = full * 16000.0;
    const double information =
        MeanInformation({.wall_e = wall_e, .frame_e = wall_e / 16.0}, noise, LensOf(0.6));
    // The figures have two digits.
    EXPECT_NEAR(1.0 / std::sqrt(information), bound_px, 0.04 * bound_px) << full;
  }
}

TEST(BorderProfileTest, PixelsInFlatPlacesTellTheLevelsAndNothingElse) {
  const BlurredEdge edge(0.4, {1.0, 0.0});
  const PixelNoise noise = PixelNoise::Linear(SensorOfNoise(10.0), {});
  const auto information = [&](double margin_px) {
    return InformationOf({.outer = {edge, 50.3, -1.0},
                          .inner = EdgeCrossing{edge, 30.1, -1.0},
                          .margin_px = margin_px,
                          .first = 0,
                          .last = 99},
                         {.wall_e = 900.0, .frame_e = 100.0, .opening_e = 400.0}, noise);
  };
  const BorderInformation more = information(12.0) - information(4.0);
  const double variance = noise.Variance(500.0);
  BorderInformation expected = BorderInformation::Zero();
  expected(3, 3) = expected(5, 5) = 8.0 / variance;
  EXPECT_TRUE(more.isApprox(expected, 1e-9)) << more;
  // Without contrast there is nothing to tell of places.
  const BorderInformation grey = InformationOf(
      {.outer = {edge, 50.3, 1.0}, .inner = {}, .margin_px = 4, .first = 0, .last = 99},
      {.wall_e = 500.0, .frame_e = 500.0}, noise);
  EXPECT_EQ(grey(0, 0), 0.0);
}

TEST(BorderProfileTest, ANarrowBorderTellsLessOfEachOfItsEdges) {
  const BlurredEdge edge(0.5, {1.0, 0.0});
  const PixelNoise noise = PixelNoise::Linear(SensorOfNoise(10.0), {});
  const auto information = [&](double border_px) {
    return InformationOf({.outer = {edge, 30.2, 1.0},
                          .inner = EdgeCrossing{edge, 30.2 + border_px, 1.0},
                          .margin_px = 8.0,
                          .first = 0,
                          .last = 99},
                         {.wall_e = 900.0, .frame_e = 100.0, .opening_e = 900.0}, noise);
  };
  // Far apart, one edge says nothing of the other's place; side by side both blur into one dip.
  EXPECT_EQ(information(20.0)(0, 1), 0.0);
  EXPECT_LT(information(1.0)(0, 1), 0.0);
}

TEST(BorderProfileTest, SaturatedPixelsTellNothing) {
  const BlurredEdge edge(0.4, {1.0, 0.0});
  const PixelNoise noise = PixelNoise::Linear(SensorOfNoise(10.0), {});
  const BorderInformation information = InformationOf(
      {.outer = {edge, 50.0, 1.0}, .inner = {}, .margin_px = 5, .first = 0, .last = 99},
      {.wall_e = 65535.0, .frame_e = 65530.0}, noise);
  EXPECT_EQ(information.norm(), 0.0);
}

}  // namespace
}  // namespace fenestra
