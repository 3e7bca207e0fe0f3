#include "renderers/tracing/pane_kernels.h"

#include <limits>

#include "core/system/wide.h"

namespace fenestra {
namespace {

// A ray that hits nothing goes to infinity. Embree's packets of 4 and 8, though not those of 16,
// insist on finite origins even in lanes that are not traced.
inline float FiniteOr0(float t) {
  return t < std::numeric_limits<float>::max() ? t : 0.0f;
}

}  // namespace

FENESTRA_WIDE RTCRay16 RaysFromHits(const RayPacket& packet, float offset_m,
                                    const glm::vec3& direction_W) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  RTCRay16 out;
  for (int i = 0; i < kLanes; ++i) {
    const float nx = hit.Ng_x[i];
    const float ny = hit.Ng_y[i];
    const float nz = hit.Ng_z[i];
    const float facing = nx * ray.dir_x[i] + ny * ray.dir_y[i] + nz * ray.dir_z[i];
    const float unit = offset_m / std::sqrt(nx * nx + ny * ny + nz * nz);
    const float off = facing < 0.0f ? unit : -unit;
    const float t = FiniteOr0(ray.tfar[i]);
    out.org_x[i] = ray.org_x[i] + t * ray.dir_x[i] + off * nx;
    out.org_y[i] = ray.org_y[i] + t * ray.dir_y[i] + off * ny;
    out.org_z[i] = ray.org_z[i] + t * ray.dir_z[i] + off * nz;
    out.tnear[i] = 0.0f;
    out.dir_x[i] = direction_W.x;
    out.dir_y[i] = direction_W.y;
    out.dir_z[i] = direction_W.z;
    out.time[i] = 0.0f;
    out.tfar[i] = std::numeric_limits<float>::infinity();
    out.mask[i] = ~0u;
    out.id[i] = 0u;
    out.flags[i] = 0u;
  }
  return out;
}

FENESTRA_WIDE Lanes<float> PaneReflectances(const LaneMask& panes, const RayPacket& packet,
                                            const float* index) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  // Fetched first, so that the arithmetic is done in all lanes at once.
  Lanes<float> n;
  for (int i = 0; i < kLanes; ++i) n[i] = index[panes[i] != 0 ? hit.primID[i] : 0u];
  Lanes<float> reflectance;
  for (int i = 0; i < kLanes; ++i) {
    const float nx = hit.Ng_x[i];
    const float ny = hit.Ng_y[i];
    const float nz = hit.Ng_z[i];
    const float dx = ray.dir_x[i];
    const float dy = ray.dir_y[i];
    const float dz = ray.dir_z[i];
    const float nn = nx * nx + ny * ny + nz * nz;
    const float dd = dx * dx + dy * dy + dz * dz;
    const float nd = nx * dx + ny * dy + nz * dz;
    const float cosine = (nd < 0.0f ? -nd : nd) / std::sqrt(nn * dd);
    const float R = PaneReflectance(cosine, n[i]);
    reflectance[i] = panes[i] != 0 ? R : 0.0f;
  }
  return reflectance;
}

FENESTRA_WIDE RayPacket MirroredRays(const LaneMask& panes, const RayPacket& packet,
                                     float offset_m) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  RayPacket out;
  for (int i = 0; i < kLanes; ++i) {
    const bool on = panes[i] != 0;
    const float nx = hit.Ng_x[i];
    const float ny = hit.Ng_y[i];
    const float nz = hit.Ng_z[i];
    const float dx = ray.dir_x[i];
    const float dy = ray.dir_y[i];
    const float dz = ray.dir_z[i];
    const float nn = nx * nx + ny * ny + nz * nz;
    const float nd = nx * dx + ny * dy + nz * dz;
    const float twice = 2.0f * nd / nn;
    const float unit = offset_m / std::sqrt(nn);
    const float off = nd < 0.0f ? unit : -unit;
    const float t = FiniteOr0(ray.tfar[i]);
    out.ray.org_x[i] = ray.org_x[i] + t * dx + off * nx;
    out.ray.org_y[i] = ray.org_y[i] + t * dy + off * ny;
    out.ray.org_z[i] = ray.org_z[i] + t * dz + off * nz;
    out.ray.tnear[i] = 0.0f;
    out.ray.dir_x[i] = on ? dx - twice * nx : 0.0f;
    out.ray.dir_y[i] = on ? dy - twice * ny : 0.0f;
    out.ray.dir_z[i] = on ? dz - twice * nz : 0.0f;
    out.ray.time[i] = 0.0f;
    out.ray.tfar[i] = std::numeric_limits<float>::infinity();
    out.ray.mask[i] = ~0u;
    out.ray.id[i] = 0u;
    out.ray.flags[i] = 0u;
    out.hit.Ng_x[i] = 0.0f;
    out.hit.Ng_y[i] = -1.0f;
    out.hit.Ng_z[i] = 0.0f;
    out.hit.u[i] = 0.0f;
    out.hit.v[i] = 0.0f;
    out.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
    out.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    out.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  return out;
}

}  // namespace fenestra
