#pragma once

#include <glm/vec3.hpp>

#include "renderers/tracing/packet.h"

namespace fenestra {

/// Rays from all hits towards a distant light, starting `offset_m` off the surface on the side
/// that the packet's rays came from.
RTCRay16 RaysFromHits(const RayPacket& packet, float offset_m, const glm::vec3& direction_W);

/// Reflectances of the panes that lanes of the mask have hit, 0 in other lanes; `index` is the
/// refractive index of each triangle.
Lanes<float> PaneReflectances(const LaneMask& panes, const RayPacket& packet, const float* index);

/// Rays mirrored where lanes of the mask have hit panes, starting `offset_m` before them; other
/// lanes have no direction.
RayPacket MirroredRays(const LaneMask& panes, const RayPacket& packet, float offset_m);

}  // namespace fenestra
