#pragma once

#include <cstdint>
#include <vector>

#include "renderers/light/light_bake.h"
#include "renderers/light/spectrum.h"
#include "renderers/tracing/packet.h"
#include "renderers/tracing/triangle_soup.h"

namespace fenestra {

/// A linear function of two coordinates of a hit.
struct LinearLight {
  float at_0 = 0.0f;
  float per_x = 0.0f;
  float per_y = 0.0f;
};

/// Light leaving all surfaces in one channel, without lamps and patterns: with the part V of the
/// sunlight that arrives,
///
///     L = ambient(s, t) + V max(sun(u, v), 0).
struct SurfaceLight {
  /// Of each leaf (see LightLeaves) in (s, t); of SkyLeaf and GroundLeaf after them.
  std::vector<LinearLight> ambient;
  /// Of each side (see SideIndex) in barycentric (u, v); 0 if the sun is behind it.
  std::vector<LinearLight> sun;
};

inline uint32_t SkyLeaf(const LightBake& bake) {
  return static_cast<uint32_t>(bake.leaves.leaves().size());
}
inline uint32_t GroundLeaf(const LightBake& bake) {
  return SkyLeaf(bake) + 1;
}

/// For the irradiance `ambient` of the bake's points; 0 for the sky. In channels of arriving light
/// it is the irradiance itself, and 0 for sky and ground.
SurfaceLight LightSurfaces(const Scene& scene, const TriangleSoup& soup, const LightBake& bake,
                           const std::vector<Spectrum>& ambient, const Lighting& lighting,
                           Channel channel);

/// Different values of a packet's lanes. They are few, and all lanes of one are shaded at once.
struct LaneGroups {
  Lanes<uint32_t> values;
  int count = 0;
};
LaneGroups GroupsOf(const Lanes<uint32_t>& values);

/// Where light is looked up for each hit.
struct LeavesHit {
  Lanes<uint32_t> leaf;  ///< Index into SurfaceLight::ambient.
  Lanes<float> s;
  Lanes<float> t;
  LaneGroups groups;  ///< Of the leaves.
};
LeavesHit FindLeaves(const LightBake& bake, const Lanes<uint32_t>& side_hit,
                     const RayPacket& packet);

/// The light that leaves each hit: AmbientLeaving without the sun's light, SunLeaving the sun's
/// light if it reaches the hit. `groups` are those of the sides hit.
Lanes<float> AmbientLeaving(const LinearLight* ambient, const LeavesHit& hit);
Lanes<float> SunLeaving(const LinearLight* sun, const LaneGroups& groups,
                        const Lanes<uint32_t>& side_hit, const RayPacket& packet);

}  // namespace fenestra
