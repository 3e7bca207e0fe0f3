#include "renderers/lit_surfaces.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

namespace fenestra {
namespace {

// Rec. ITU-R BT.709, luminance of linear red, green and blue.
constexpr float kRedLuminance = 0.2126f;
constexpr float kGreenLuminance = 0.7152f;
constexpr float kBlueLuminance = 0.0722f;

}  // namespace

std::vector<Channel> ChannelsOf(Band band) {
  switch (band) {
    case Band::kRgb:
      return {Channel::kBlue, Channel::kGreen, Channel::kRed};
    case Band::kInfrared:
      return {Channel::kInfrared};
    case Band::kLuminance:
      break;
  }
  return {Channel::kLuminance};
}

float ReflectanceIn(Channel channel, const Material& material) {
  const glm::vec3& rgb = material.reflectance_rgb;
  switch (channel) {
    case Channel::kLuminance:
      return kRedLuminance * rgb.r + kGreenLuminance * rgb.g + kBlueLuminance * rgb.b;
    case Channel::kRed:
      return rgb.r;
    case Channel::kGreen:
      return rgb.g;
    case Channel::kBlue:
      return rgb.b;
    case Channel::kInfrared:
      return material.reflectance_830nm;
    case Channel::kIlluminance:
      break;
  }
  return 1.0f;
}

std::vector<SideRadiance> LightSurfaces(const Scene& scene, const TriangleSoup& soup,
                                        const std::vector<TriangleSkyView>& sky_views,
                                        const Lighting& lighting, Channel channel) {
  constexpr double kPi = std::numbers::pi;
  const double per_lux = channel == Channel::kInfrared ? lighting.irradiance_830_per_lux : 1.0;
  const bool illuminance = channel == Channel::kIlluminance;
  const bool sun_is_up = lighting.sun.Direction_W().y() > 0.0;
  const double E_sun = sun_is_up ? lighting.sun.illuminance_lx * per_lux : 0.0;
  const double E_sky = lighting.sky.illuminance_lx * per_lux;
  const double E_ground = E_sky * lighting.sky.ground_reflectance;
  const Eigen::Vector3d sun = lighting.sun.Direction_W();
  const glm::dvec3 to_sun(sun.x(), sun.y(), sun.z());

  std::vector<SideRadiance> sides;
  sides.reserve(2 * soup.size() + 2);
  for (size_t t = 0; t < soup.size(); ++t) {
    const Material& material = scene.materials[scene.meshes[soup.mesh_of[t]].material];
    const double per_E =
        illuminance ? 1.0 : static_cast<double>(ReflectanceIn(channel, material)) / kPi;
    const double cos_sun = glm::dot(glm::dvec3(soup.normals_W[t]), to_sun);
    for (const bool front : {true, false}) {
      const TriangleSkyView& view = sky_views[SideIndex(t, front)];
      const auto sky_at = [&](size_t corner) {
        return per_E * (E_sky * static_cast<double>(view[corner].sky) +
                        E_ground * static_cast<double>(view[corner].ground));
      };
      const double sky = sky_at(0);
      sides.push_back(
          {.sky = static_cast<float>(sky),
           .sky_u = static_cast<float>(sky_at(1) - sky),
           .sky_v = static_cast<float>(sky_at(2) - sky),
           .sun = static_cast<float>(per_E * E_sun * std::max(front ? cos_sun : -cos_sun, 0.0))});
    }
  }
  for (const double E : {E_sky, E_ground}) {
    const double L = illuminance ? 0.0 : E / kPi;
    sides.push_back({.sky = static_cast<float>(L), .sky_u = 0.0f, .sky_v = 0.0f, .sun = 0.0f});
  }
  return sides;
}

}  // namespace fenestra
