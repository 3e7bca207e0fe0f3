#include "renderers/light_transport.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/check.h"
#include "renderers/fresnel.h"

namespace fenestra {
namespace {

uint32_t Mix(uint32_t key, uint32_t other) {
  return (key * 0x9e3779b1u) ^ (other + 0x7f4a7c15u);
}

// Where lanes of a packet hit panes, and the mirrored rays from there.
struct PaneHits {
  LaneMask mask;
  Lanes<float> reflectance;
  RayPacket mirrored;
  bool any = false;
};

glm::vec3 At(const float* x, const float* y, const float* z, int i) {
  return {x[i], y[i], z[i]};
}

PaneHits FindPaneHits(const TracedScene& traced, const LaneMask& mask, const RayPacket& packet,
                      float offset_m) {
  PaneHits hits;
  const RTCRay16& r = packet.ray;
  const RTCHit16& h = packet.hit;
  hits.mirrored = packet;
  Directions directions;
  Lanes<glm::vec3> origins;
  for (int i = 0; i < kLanes; ++i) {
    hits.mask[i] = mask[i] != 0 && h.geomID[i] != RTC_INVALID_GEOMETRY_ID ? -1 : 0;
    if (hits.mask[i] == 0) continue;
    hits.any = true;
    hits.reflectance[i] =
        PaneReflectance(HitCosine(packet, i), traced.refractive_index(h.primID[i]));
    const glm::vec3 d = At(r.dir_x, r.dir_y, r.dir_z, i);
    glm::vec3 n = glm::normalize(At(h.Ng_x, h.Ng_y, h.Ng_z, i));
    if (glm::dot(n, d) > 0.0f) n = -n;
    const glm::vec3 mirrored = d - 2.0f * glm::dot(d, n) * n;
    directions.x[i] = mirrored.x;
    directions.y[i] = mirrored.y;
    directions.z[i] = mirrored.z;
    origins[i] = At(r.org_x, r.org_y, r.org_z, i) + r.tfar[i] * d + offset_m * n;
  }
  if (!hits.any) return hits;
  SetRays(hits.mirrored, glm::vec3(0.0f), directions);
  for (int i = 0; i < kLanes; ++i) {
    hits.mirrored.ray.org_x[i] = origins[i].x;
    hits.mirrored.ray.org_y[i] = origins[i].y;
    hits.mirrored.ray.org_z[i] = origins[i].z;
  }
  return hits;
}

}  // namespace

std::vector<uint32_t> MakeSideKeys(const TriangleSoup& soup) {
  std::vector<uint32_t> keys;
  keys.reserve(2 * soup.size() + 2);
  for (const uint32_t plane : NumberPlanes(soup)) {
    for (const uint32_t side : {0u, 1u}) keys.push_back(8 + 4 * (2 * plane + side));
  }
  keys.push_back(0);  // Sky.
  keys.push_back(4);  // Ground.
  return keys;
}

LightTransport::LightTransport(const Surfaces& surfaces, const Lighting& lighting,
                               const std::vector<Channel>& channels, const glm::vec3& viewer_W)
    : surfaces_(surfaces),
      has_sun_(lighting.sun.illuminance_lx > 0.0 && lighting.sun.Direction_W().y() > 0.0),
      offset_m_(surfaces.traced.SurfaceOffset(viewer_W)) {
  FENESTRA_CHECK(channels.size() <= kMostChannels, "too many channels");
  const Eigen::Vector3f to_sun = lighting.sun.Direction_W().cast<float>();
  to_sun_W_ = {to_sun.x(), to_sun.y(), to_sun.z()};
  for (const Channel channel : channels) {
    sides_.push_back(LightSurfaces(surfaces.scene, surfaces.traced.opaque(), surfaces.sky_views,
                                   lighting, channel));
  }
}

Lanes<float> LightTransport::SunReaching(const LaneMask& mask, const RayPacket& packet,
                                         const Lanes<float>& sun_facing) const {
  LaneMask towards_sun;
  int any = 0;
  for (int i = 0; i < kLanes; ++i) {
    towards_sun[i] = mask[i] & (sun_facing[i] > 0.0f ? -1 : 0);
    any |= towards_sun[i];
  }
  if (any == 0) return {};
  RTCRay16 rays = RaysFromHits(packet, offset_m_, to_sun_W_);
  return surfaces_.traced.Transmittance(towards_sun, rays, Coherence::kCoherent);
}

LightTransport::Ends LightTransport::TraceOpaque(const LaneMask& mask, RayPacket& packet) const {
  surfaces_.traced.opaque_tracer().Intersect(mask, packet, Coherence::kCoherent);
  Ends ends;
  ends.side_hit = SidesHit(packet, static_cast<uint32_t>(surfaces_.traced.opaque().size()));
  std::array<LaneLight, kMostChannels> light;
  Lanes<float> sun_facing;
  for (int c = 0; c < channel_count(); ++c) {
    const auto k = static_cast<size_t>(c);
    light[k] = LightLeaving(sides_[k].data(), ends.side_hit, packet);
    ends.radiance[k] = light[k].sky;
    for (int i = 0; i < kLanes; ++i) sun_facing[i] = std::max(sun_facing[i], light[k].sun[i]);
  }
  if (!has_sun_) return ends;
  ends.sun = SunReaching(mask, packet, sun_facing);
  for (int c = 0; c < channel_count(); ++c) {
    const auto k = static_cast<size_t>(c);
    for (int i = 0; i < kLanes; ++i) ends.radiance[k][i] += light[k].sun[i] * ends.sun[i];
  }
  return ends;
}

LightTransport::Arriving LightTransport::WithKeys(const Ends& ends) const {
  Arriving arriving{.radiance = ends.radiance,
                    .key = LookUp(surfaces_.side_keys.data(), ends.side_hit)};
  for (int i = 0; i < kLanes; ++i) arriving.key[i] |= ends.sun[i] > 0.0f ? 1u : 0u;
  return arriving;
}

void LightTransport::LookThroughPanes(const LaneMask& mask, const RayPacket& packet,
                                      Arriving& arriving) const {
  const TracedScene& traced = surfaces_.traced;
  RayPacket pane_packet = packet;
  LaneMask active = mask;
  Lanes<float> throughput;
  throughput.v.fill(1.0f);
  std::array<Lanes<float>, kMostChannels> mirrored{};
  for (int pane = 0; pane < TracedScene::kMostPanes; ++pane) {
    std::fill_n(pane_packet.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    traced.pane_tracer().Intersect(active, pane_packet, Coherence::kCoherent);
    PaneHits hits = FindPaneHits(traced, active, pane_packet, offset_m_);
    if (!hits.any) break;
    const Arriving mirror = WithKeys(TraceOpaque(hits.mask, hits.mirrored));
    for (int i = 0; i < kLanes; ++i) {
      if (hits.mask[i] == 0) continue;
      for (int c = 0; c < channel_count(); ++c) {
        const auto k = static_cast<size_t>(c);
        mirrored[k][i] += throughput[i] * hits.reflectance[i] * mirror.radiance[k][i];
      }
      throughput[i] *= 1.0f - hits.reflectance[i];
      arriving.key[i] = Mix(arriving.key[i], mirror.key[i]);
      pane_packet.ray.tnear[i] = TracedScene::Beyond(pane_packet.ray.tfar[i]);
      pane_packet.ray.tfar[i] = packet.ray.tfar[i];
    }
    active = hits.mask;
  }
  for (int c = 0; c < channel_count(); ++c) {
    const auto k = static_cast<size_t>(c);
    for (int i = 0; i < kLanes; ++i) {
      arriving.radiance[k][i] = mirrored[k][i] + throughput[i] * arriving.radiance[k][i];
    }
  }
}

LightTransport::Arriving LightTransport::Trace(const LaneMask& mask, RayPacket& packet) const {
  Arriving arriving = WithKeys(TraceOpaque(mask, packet));
  if (surfaces_.traced.has_panes()) LookThroughPanes(mask, packet, arriving);
  return arriving;
}

}  // namespace fenestra
