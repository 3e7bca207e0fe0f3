#pragma once

#include <cstdint>
#include <vector>

#include "renderers/light/light_bake.h"
#include "renderers/light/spectrum.h"
#include "renderers/tracing/packet.h"
#include "renderers/tracing/triangle_soup.h"

namespace fenestra {

/// Light leaving one side of a triangle in one channel, as a function of a hit's barycentric (u, v)
/// and of the part V of the sunlight that arrives, without lamps and patterns:
///
///     L(u, v, V) = ambient + ambient_u u + ambient_v v + V max(sun + sun_u u + sun_v v, 0).
struct SideRadiance {
  float ambient = 0.0f;
  float ambient_u = 0.0f;
  float ambient_v = 0.0f;
  float sun = 0.0f;  ///< 0, as are its derivatives, if the sun is behind this side.
  float sun_u = 0.0f;
  float sun_v = 0.0f;
};

/// Radiance of all sides, for the irradiance `ambient` of the bake's points; 0 for the sky. In
/// channels of arriving light it is the irradiance itself, and 0 for sky and ground.
std::vector<SideRadiance> LightSurfaces(const Scene& scene, const TriangleSoup& soup,
                                        const LightBake& bake, const std::vector<Spectrum>& ambient,
                                        const Lighting& lighting, Channel channel);

/// The different sides that a packet has hit. They are few, and all lanes of one side are shaded at
/// once.
struct SideGroups {
  Lanes<uint32_t> sides;
  int count = 0;
};
SideGroups GroupsOf(const Lanes<uint32_t>& side_hit);

/// The light that leaves each hit: AmbientLeaving without the sun's light, SunLeaving the sun's
/// light if it reaches the hit. `groups` are those of the sides hit.
Lanes<float> AmbientLeaving(const SideRadiance* sides, const SideGroups& groups,
                            const Lanes<uint32_t>& side_hit, const RayPacket& packet);
Lanes<float> SunLeaving(const SideRadiance* sides, const SideGroups& groups,
                        const Lanes<uint32_t>& side_hit, const RayPacket& packet);

}  // namespace fenestra
