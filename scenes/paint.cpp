#include "scenes/paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace fenestra {
namespace {

struct NamedHue {
  const char* name;
  glm::dvec3 rgb;  // Linear, of any luminance.
};

// Hues in the order of the enumeration: linear values of typical sRGB colours: brick (165, 100,
// 80), ochre plaster (205, 170, 110), brown wood paint (90, 60, 40), foliage (66, 97, 56), blue
// paint (50, 80, 130). Chosen by eye.
constexpr std::array<NamedHue, 6> kHues{{
    {"neutral", {1.0, 1.0, 1.0}},
    {"brick_red", {0.376, 0.127, 0.080}},
    {"ochre", {0.610, 0.402, 0.156}},
    {"brown", {0.102, 0.045, 0.021}},
    {"green", {0.055, 0.120, 0.040}},
    {"blue", {0.032, 0.080, 0.223}},
}};

// Rec. ITU-R BT.709.
constexpr glm::dvec3 kLuminance{0.2126, 0.7152, 0.0722};

}  // namespace

const std::vector<std::string>& HueNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const NamedHue& hue : kHues) all.emplace_back(hue.name);
    return all;
  }();
  return names;
}

glm::dvec3 HueRgb(Hue hue) {
  const glm::dvec3& rgb = kHues.at(static_cast<size_t>(hue)).rgb;
  return rgb / glm::dot(rgb, kLuminance);
}

double MostReflectance(Hue hue) {
  const glm::dvec3 rgb = HueRgb(hue);
  return 1.0 / std::max({rgb.r, rgb.g, rgb.b});
}

void CheckPaint(const std::string& name, const Paint& paint, Faults& faults) {
  faults.RequireWithin(name + "_reflectance", paint.reflectance, 0.0, 1.0);
  faults.RequireWithin(name + "_reflectance_830nm", paint.reflectance_830nm, 0.0, 1.0);
  const double most = MostReflectance(paint.hue);
  faults.Require(!(paint.reflectance > most) || paint.reflectance > 1.0,
                 fmt::format("{}_reflectance can be up to {:.3f} in {}, not {}", name, most,
                             HueNames().at(static_cast<size_t>(paint.hue)), paint.reflectance));
}

Material MaterialOf(const std::string& name, const Paint& paint) {
  return {.name = name,
          .reflectance_rgb = glm::vec3(paint.reflectance * HueRgb(paint.hue)),
          .reflectance_830nm = static_cast<float>(paint.reflectance_830nm)};
}

}  // namespace fenestra
