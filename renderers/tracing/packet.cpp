#include "renderers/tracing/packet.h"

#include <limits>

#include "core/system/wide.h"

namespace fenestra {

LaneMask FirstLanes(int count) {
  LaneMask mask;
  for (int i = 0; i < kLanes; ++i) mask[i] = i < count ? -1 : 0;
  return mask;
}

FENESTRA_WIDE void SetRays(RayPacket& packet, const glm::vec3& origin_W,
                           const Directions& directions_W) {
  const Directions d = directions_W;  // A copy cannot overlap the packet, so the loop vectorises.
  RTCRay16& ray = packet.ray;
  RTCHit16& hit = packet.hit;
  for (int i = 0; i < kLanes; ++i) {
    ray.org_x[i] = origin_W.x;
    ray.org_y[i] = origin_W.y;
    ray.org_z[i] = origin_W.z;
    ray.tnear[i] = 0.0f;
    ray.dir_x[i] = d.x[i];
    ray.dir_y[i] = d.y[i];
    ray.dir_z[i] = d.z[i];
    ray.time[i] = 0.0f;
    ray.tfar[i] = std::numeric_limits<float>::infinity();
    ray.mask[i] = ~0u;
    ray.id[i] = 0u;
    ray.flags[i] = 0u;
    hit.Ng_x[i] = 0.0f;
    hit.Ng_y[i] = -1.0f;
    hit.Ng_z[i] = 0.0f;
    hit.u[i] = 0.0f;
    hit.v[i] = 0.0f;
    hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
    hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

}  // namespace fenestra
