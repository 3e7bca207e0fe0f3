#include "core/io/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fenestra {
namespace {

TEST(SrgbTest, TheTableEqualsTheFormulaForEveryValue) {
  constexpr int kCount = 200000;
  cv::Mat1f linear(1, kCount);
  for (int i = 0; i < kCount; ++i) linear(i) = static_cast<float>(i) / (kCount - 1);
  const cv::Mat1b encoded = EncodeSrgb(linear);
  for (int i = 0; i < kCount; ++i) {
    const double exact = 255.0 * SrgbFromLinear(linear(i));
    // Half a code, and a float's rounding at the border between two codes.
    ASSERT_LE(std::abs(encoded(i) - exact), 0.5 + 1e-4) << i;
  }
}

TEST(SrgbTest, BlackPaintOnAWallExposedTo128Is31) {
  // The wall at code 128 has reflectance 0.80; paint of 0.05 then gets code 31: the threshold of
  // 50 in the paper's Algorithm 1 rests on this.
  const double wall = LinearFromSrgb(128.0 / 255.0);
  EXPECT_NEAR(255.0 * SrgbFromLinear(wall * 0.05 / 0.80), 31.0, 1.0);
}

TEST(SrgbTest, EncodingIsTheInverseOfDecoding) {
  for (int code = 0; code < 256; ++code) {
    const double v = code / 255.0;
    // The standard rounds the border between the two branches to 2e-8.
    EXPECT_NEAR(SrgbFromLinear(LinearFromSrgb(v)), v, 1e-7) << code;
  }
}

TEST(SrgbTest, TheSlopeIsTheDifferenceQuotient) {
  for (const double x : {0.001, 0.01, 0.2, 0.9}) {
    constexpr double kStep = 1e-6;
    const double quotient = (SrgbFromLinear(x + kStep) - SrgbFromLinear(x - kStep)) / (2.0 * kStep);
    // Second order: the third derivative is at most 1e6 at 0.01 and above.
    EXPECT_NEAR(SrgbSlope(x), quotient, 1e-5) << x;
  }
}

TEST(SrgbTest, ValuesOutsideTheRangeAreClipped) {
  const cv::Mat1b encoded = EncodeSrgb((cv::Mat1f(1, 2) << -1.0f, 2.0f));
  EXPECT_EQ(encoded(0), 0);
  EXPECT_EQ(encoded(1), 255);
}

}  // namespace
}  // namespace fenestra
