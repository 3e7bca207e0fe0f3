#pragma once

#include <cstdint>
#include <vector>

#include "renderers/ray_caster.h"
#include "renderers/sky_view.h"

namespace fenestra {

/// Light leaving one side of a triangle, as a function of a hit's barycentric (u, v) and of the
/// part V of the sunlight that arrives:
///
///     L(u, v, V) = sky + sky_u u + sky_v v + sun V.
struct SideRadiance {
  float sky;
  float sky_u;
  float sky_v;
  float sun;  ///< 0 where the sun stands behind this side.
};

/// Index of the side of a surface in SideRadiance tables: see SkyView. After the last triangle
/// follow the sky and the ground, as if they were the two sides of one more triangle.
constexpr size_t SideIndex(size_t triangle, bool front) {
  return 2 * triangle + (front ? 0 : 1);
}

/// One quantity in which light is measured.
enum class Channel { kLuminance, kRed, kGreen, kBlue, kInfrared, kIlluminance };

/// The channels of a band, in the order of its image.
std::vector<Channel> ChannelsOf(Band band);

/// The reflectance that a channel sees. 1 for kIlluminance.
float ReflectanceIn(Channel channel, const Material& material);

/// Radiance of all sides under this light; of Lambert surfaces, L = ρ/π E with
/// E = E_sun cos θ V + E_h (sky + ρ_g ground). For kIlluminance it is E itself [lx], and 0 for
/// the sky and the ground.
std::vector<SideRadiance> LightSurfaces(const Scene& scene, const TriangleSoup& soup,
                                        const std::vector<TriangleSkyView>& sky_views,
                                        const Lighting& lighting, Channel channel);

}  // namespace fenestra
