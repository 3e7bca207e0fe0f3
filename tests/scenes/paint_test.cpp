#include "scenes/paint.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fenestra {
namespace {

double Luminance(const glm::vec3& rgb) {
  return 0.2126 * static_cast<double>(rgb.r) + 0.7152 * static_cast<double>(rgb.g) +
         0.0722 * static_cast<double>(rgb.b);
}

TEST(Paint, OfAnyHueHasItsLuminance) {
  for (const std::string& hue : Hues()) {
    const Material m =
        MaterialOf("paint", {.reflectance = 0.2, .reflectance_830nm = 0.6, .hue = hue});
    EXPECT_NEAR(Luminance(m.reflectance_rgb), 0.2, 1e-7) << hue;  // Single precision.
    EXPECT_EQ(m.reflectance_830nm, 0.6f) << hue;
  }
}

TEST(Paint, AtItsMostReflectsAllLightOfOneColour) {
  for (const std::string& hue : Hues()) {
    const glm::vec3 rgb =
        MaterialOf("paint", {.reflectance = MostReflectance(hue), .hue = hue}).reflectance_rgb;
    EXPECT_FLOAT_EQ(std::max({rgb.r, rgb.g, rgb.b}), 1.0f) << hue;
  }
}

TEST(Paint, NeutralIsGreyAndTheOthersAreNot) {
  for (const std::string& hue : Hues()) {
    const glm::dvec3 rgb = HueRgb(hue);
    EXPECT_EQ(rgb.r == rgb.g && rgb.g == rgb.b, hue == "neutral") << hue;
  }
}

}  // namespace
}  // namespace fenestra
