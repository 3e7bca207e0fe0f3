#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "renderers/tracing/packet.h"

namespace fenestra {

/// Fresnel reflectance of one air-to-glass surface for unpolarised light.
/// c: cosine of the angle of incidence in air, in [0, 1]; n ≥ 1: refractive index.
///
///     c' = √(n² − 1 + c²)/n,   F = ½ [((c − n c')/(c + n c'))² + ((n c − c')/(n c + c'))²]
inline float FresnelReflectance(float c, float n) {
  const float c_inside = std::sqrt((n * n - 1.0f) + c * c) / n;
  const float s = (c - n * c_inside) / (c + n * c_inside);
  const float p = (n * c - c_inside) / (n * c + c_inside);
  return 0.5f * (s * s + p * p);
}

/// Reflectance of a pane with all reflections between its two faces, without absorption and
/// interference: R = F + (1 − F)² F / (1 − F²) = 2F / (1 + F). The pane transmits 1 − R.
/// Averaging the polarisations before summing the series overstates R at the Brewster angle by
/// less than 0.01.
inline float PaneReflectance(float c, float n) {
  // Written out, since a clamp is a function call to a vectoriser.
  const float c_up = c > 1e-4f ? c : 1e-4f;
  const float F = FresnelReflectance(c_up < 1.0f ? c_up : 1.0f, n);
  return 2.0f * F / (1.0f + F);
}

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
