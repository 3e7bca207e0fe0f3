#include "scenes/paint.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fenestra {
namespace {

constexpr Hue kAllHues[] = {Hue::kNeutral, Hue::kBrickRed, Hue::kOchre,
                            Hue::kBrown,   Hue::kGreen,    Hue::kBlue};

double Luminance(const glm::vec3& rgb) {
  return 0.2126 * static_cast<double>(rgb.r) + 0.7152 * static_cast<double>(rgb.g) +
         0.0722 * static_cast<double>(rgb.b);
}

TEST(Paint, OfAnyHueHasItsLuminance) {
  for (const Hue hue : kAllHues) {
    const Material m =
        MaterialOf("paint", {.reflectance = 0.2, .reflectance_830nm = 0.6, .hue = hue});
    EXPECT_NEAR(Luminance(m.reflectance_rgb), 0.2, 1e-7)
        << HueNames()[static_cast<size_t>(hue)];  // Single precision.
    EXPECT_EQ(m.reflectance_830nm, 0.6f) << HueNames()[static_cast<size_t>(hue)];
  }
}

TEST(Paint, AtItsMostReflectsAllLightOfOneColour) {
  for (const Hue hue : kAllHues) {
    const glm::vec3 rgb =
        MaterialOf("paint", {.reflectance = MostReflectance(hue), .hue = hue}).reflectance_rgb;
    EXPECT_FLOAT_EQ(std::max({rgb.r, rgb.g, rgb.b}), 1.0f) << HueNames()[static_cast<size_t>(hue)];
  }
}

TEST(Paint, NeutralIsGreyAndTheOthersAreNot) {
  for (const Hue hue : kAllHues) {
    const glm::dvec3 rgb = HueRgb(hue);
    EXPECT_EQ(rgb.r == rgb.g && rgb.g == rgb.b, hue == Hue::kNeutral)
        << HueNames()[static_cast<size_t>(hue)];
  }
}

}  // namespace
}  // namespace fenestra
