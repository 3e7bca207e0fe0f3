#include "renderers/light/light_transport.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/system/check.h"
#include "core/system/wide.h"
#include "renderers/light/diffuse_light.h"
#include "renderers/tracing/pane_kernels.h"

namespace fenestra {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

uint32_t Mix(uint32_t key, uint32_t other) {
  return (key * 0x9e3779b1u) ^ (other + 0x7f4a7c15u);
}

glm::vec3 At(const float* x, const float* y, const float* z, int i) {
  return {x[i], y[i], z[i]};
}

glm::vec3 DirectionOf(const RayPacket& packet, int i) {
  return At(packet.ray.dir_x, packet.ray.dir_y, packet.ray.dir_z, i);
}

// Unit normal on the side that the ray came from.
glm::vec3 FacingNormal(const RayPacket& packet, int i) {
  const glm::vec3 n = glm::normalize(At(packet.hit.Ng_x, packet.hit.Ng_y, packet.hit.Ng_z, i));
  return glm::dot(n, DirectionOf(packet, i)) > 0.0f ? -n : n;
}

FENESTRA_WIDE bool SunwardLanes(const LaneMask& mask, const Lanes<float>& sun_facing,
                                LaneMask& towards_sun) {
  int any = 0;
  for (int i = 0; i < kLanes; ++i) {
    towards_sun[i] = mask[i] & (sun_facing[i] > 0.0f ? -1 : 0);
    any |= towards_sun[i];
  }
  return any != 0;
}

FENESTRA_WIDE void AddScaled(const Lanes<float>& light, const Lanes<float>& part,
                             Lanes<float>& sum) {
  for (int i = 0; i < kLanes; ++i) sum[i] += light[i] * part[i];
}

FENESTRA_WIDE void KeepLarger(const Lanes<float>& values, Lanes<float>& largest) {
  for (int i = 0; i < kLanes; ++i) {
    largest[i] = values[i] > largest[i] ? values[i] : largest[i];
  }
}

FENESTRA_WIDE void MarkSun(const Lanes<float>& sun, const LaneMask& disc, const LaneMask& penumbra,
                           Lanes<uint32_t>& key) {
  for (int i = 0; i < kLanes; ++i) {
    key[i] |= (sun[i] > 0.0f || disc[i] != 0) ? 1u : 0u;
    key[i] |= penumbra[i] != 0 ? 2u : 0u;
  }
}

// Whether the sun shines in some of these lanes and not in others.
bool AreMixed(const LaneMask& lanes, const Lanes<float>& sun) {
  bool lit = false;
  bool dark = false;
  for (int i = 0; i < kLanes; ++i) {
    lit = lit || (lanes[i] != 0 && sun[i] > 0.0f);
    dark = dark || (lanes[i] != 0 && !(sun[i] > 0.0f));
  }
  return lit && dark;
}

}  // namespace

std::vector<uint32_t> MakeSideKeys(const std::vector<uint32_t>& surfaces) {
  std::vector<uint32_t> keys;
  keys.reserve(2 * surfaces.size() + 2);
  for (const uint32_t surface : surfaces) {
    for (const uint32_t side : {0u, 1u}) keys.push_back(8 + 4 * (2 * surface + side));
  }
  keys.push_back(0);  // Sky.
  keys.push_back(4);  // Ground.
  return keys;
}

LightTransport::LightTransport(const Surfaces& surfaces, const std::vector<Spectrum>& ambient,
                               const Lighting& lighting, const std::vector<Channel>& channels,
                               const Viewer& viewer)
    : surfaces_(surfaces),
      channels_(channels),
      sky_(lighting),
      sky_varies_(lighting.sky.model != Sky::Model::kUniform || SunIlluminance(lighting) > 0.0),
      has_sun_(SunIlluminance(lighting) > 0.0),
      lamp_dimmer_(static_cast<float>(lighting.lamp_dimmer)),
      sun_points_(lighting.sun),
      offset_m_(surfaces.traced.SurfaceOffset(viewer.p_WC)),
      spread_(viewer.spread) {
  FENESTRA_CHECK(channels.size() <= kMostChannels, "too many channels");
  const Eigen::Vector3f to_sun = lighting.sun.Direction_W().cast<float>();
  to_sun_W_ = {to_sun.x(), to_sun.y(), to_sun.z()};
  const Scene& scene = surfaces.scene;
  for (const Channel channel : channels) {
    surface_light_.push_back(
        LightSurfaces(scene, surfaces.traced.opaque(), surfaces.bake, ambient, lighting, channel));
    const Spectrum weights = WeightsOf(channel);
    std::vector<Spectrum>& pattern = pattern_weights_.emplace_back();
    std::vector<Spectrum>& lamp = lamp_weights_.emplace_back();
    for (const Mesh& mesh : scene.meshes) {
      const Material& material = scene.materials[mesh.material];
      const Spectrum reflectance = ReflectanceSpectrum(material);
      // Under white light, a pattern scales the channel by its mean over the spectrum, weighted
      // with the reflectance or, for a surface that only emits, with the emission.
      Spectrum of = weights * reflectance;
      float sum = of.x + of.y + of.z + of.w;
      if (!(sum > 0.0f)) {
        of = weights * EmissionSpectrum(material);
        sum = of.x + of.y + of.z + of.w;
      }
      pattern.push_back(sum > 0.0f ? of * (1.0f / sum) : Spectrum(0.0f));
      lamp.push_back(IsArriving(channel) ? weights : weights * reflectance * (1.0f / kPi));
    }
    if (!sky_varies_ && !IsArriving(channel)) {
      const Spectrum L = sky_.Towards({0.0f, 1.0f, 0.0f}).radiance;
      surface_light_.back().ambient[SkyLeaf(surfaces.bake)].at_0 = glm::dot(weights, L);
    }
  }
}

// The lanes on surfaces of which other lanes have found otherwise whether the sun shines there.
LaneMask LightTransport::Undecided(const LaneMask& towards_sun, const Ends& ends) const {
  LaneMask undecided;
  for (int i = 0; i < kLanes; ++i) {
    if (towards_sun[i] == 0) continue;
    for (int k = 0; k < i; ++k) {
      const bool differ = (ends.sun[i] > 0.0f) != (ends.sun[k] > 0.0f);
      if (towards_sun[k] == 0 || !differ) continue;
      if (surfaces_.side_keys[ends.side_hit[i]] != surfaces_.side_keys[ends.side_hit[k]]) continue;
      undecided[i] = -1;
      undecided[k] = -1;
    }
  }
  // And the others of these surfaces.
  LaneMask all = undecided;
  for (int i = 0; i < kLanes; ++i) {
    for (int k = 0; k < kLanes; ++k) {
      const bool same =
          surfaces_.side_keys[ends.side_hit[i]] == surfaces_.side_keys[ends.side_hit[k]];
      if (undecided[k] != 0 && towards_sun[i] != 0 && same) all[i] = -1;
    }
  }
  return all;
}

void LightTransport::AddSun(const LaneMask& mask, const RayPacket& packet, const SunRays& sun_rays,
                            Ends& ends) const {
  const LaneGroups groups = GroupsOf(ends.side_hit);
  std::array<Lanes<float>, kMostChannels> sun;
  Lanes<float> sun_facing;
  for (size_t c = 0; c < channels_.size(); ++c) {
    sun[c] = SunLeaving(surface_light_[c].sun.data(), groups, ends.side_hit, packet);
    KeepLarger(sun[c], sun_facing);
  }
  LaneMask towards_sun;
  if (!SunwardLanes(mask, sun_facing, towards_sun)) return;
  const RTCRay16 to_centre = RaysFromHits(packet, offset_m_, to_sun_W_);
  const auto passing = [&](const LaneMask& lanes, const SunPoints::Choice& choice) {
    RTCRay16 rays = to_centre;
    if (!sun_points_.is_point()) sun_points_.Aim(choice, rays);
    return surfaces_.traced.Transmittance(lanes, rays, Coherence::kCoherent);
  };
  if (sun_points_.is_point() || sun_rays.one_point) {
    ends.sun = passing(towards_sun, {.turn = sun_rays.packet});
  } else {
    ends.sun = passing(towards_sun, {.turn = SunPoints::kRim, .shift = sun_rays.packet});
    if (AreMixed(towards_sun, ends.sun)) {
      const LaneMask undecided = Undecided(towards_sun, ends);
      Lanes<float> sum;
      Lanes<int> lit;
      for (int j = 0; j < SunPoints::kTurns; ++j) {
        const Lanes<float> passed = passing(undecided, {.turn = j, .shift = sun_rays.packet});
        for (int i = 0; i < kLanes; ++i) {
          sum[i] += passed[i];
          lit[i] += passed[i] > 0.0f ? 1 : 0;
        }
      }
      for (int i = 0; i < kLanes; ++i) {
        if (undecided[i] == 0) continue;
        ends.sun[i] = sum[i] / static_cast<float>(SunPoints::kTurns);
        ends.penumbra[i] = lit[i] > 0 && lit[i] < SunPoints::kTurns ? -1 : 0;
      }
    }
  }
  for (size_t c = 0; c < channels_.size(); ++c) AddScaled(sun[c], ends.sun, ends.radiance[c]);
}

void LightTransport::AddLamps(const LaneMask& mask, const RayPacket& packet, Ends& ends) const {
  const TriangleSoup& soup = surfaces_.traced.opaque();
  for (const Lamp& lamp : surfaces_.scene.lamps) {
    const Spectrum intensity = lamp_dimmer_ * IntensitySpectrum(lamp);
    const glm::vec3 p_WL(lamp.p_WL.x(), lamp.p_WL.y(), lamp.p_WL.z());
    RTCRay16 rays = RaysFromHits(packet, offset_m_, glm::vec3(0.0f));
    Lanes<float> E;
    LaneMask lit;
    bool any = false;
    for (int i = 0; i < kLanes; ++i) {
      if (mask[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      const glm::vec3 p(rays.org_x[i], rays.org_y[i], rays.org_z[i]);
      E[i] = LampIrradiance(lamp, p, FacingNormal(packet, i));
      if (!(E[i] > 0.0f)) continue;
      lit[i] = -1;
      any = true;
      rays.dir_x[i] = p_WL.x - p.x;
      rays.dir_y[i] = p_WL.y - p.y;
      rays.dir_z[i] = p_WL.z - p.z;
      rays.tfar[i] = 1.0f;
    }
    if (!any) continue;
    const Lanes<float> visible = surfaces_.traced.Transmittance(lit, rays, Coherence::kIncoherent);
    for (int i = 0; i < kLanes; ++i) {
      if (lit[i] == 0) continue;
      const uint32_t mesh = soup.mesh_of[packet.hit.primID[i]];
      for (size_t c = 0; c < channels_.size(); ++c) {
        ends.radiance[c][i] += E[i] * visible[i] * glm::dot(lamp_weights_[c][mesh], intensity);
      }
    }
  }
}

void LightTransport::AddSky(const LaneMask& mask, const RayPacket& packet, Ends& ends) const {
  const size_t sky_side = SideIndex(surfaces_.traced.opaque().size(), true);
  for (int i = 0; i < kLanes; ++i) {
    if (mask[i] == 0 || ends.side_hit[i] != sky_side) continue;
    const SkyLight::Seen seen = sky_.Towards(DirectionOf(packet, i));
    ends.sun_disc[i] = seen.sun ? -1 : 0;
    for (size_t c = 0; c < channels_.size(); ++c) {
      if (IsArriving(channels_[c])) continue;
      ends.radiance[c][i] = glm::dot(WeightsOf(channels_[c]), seen.radiance);
    }
  }
}

void LightTransport::ApplyPatterns(const LaneMask& mask, const RayPacket& packet,
                                   const Lanes<float>& before, Ends& ends) const {
  const SurfacePatterns& patterns = surfaces_.traced.patterns();
  const TriangleSoup& soup = surfaces_.traced.opaque();
  const Lanes<float> widths = PixelWidths(packet, before, spread_);
  for (int i = 0; i < kLanes; ++i) {
    if (mask[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const uint32_t triangle = packet.hit.primID[i];
    if (!patterns.has_pattern(triangle)) continue;
    const Spectrum factors =
        PatternSpectrum(patterns.At(triangle, packet.hit.u[i], packet.hit.v[i], widths[i]));
    for (size_t c = 0; c < channels_.size(); ++c) {
      if (IsArriving(channels_[c])) continue;
      ends.radiance[c][i] *= glm::dot(pattern_weights_[c][soup.mesh_of[triangle]], factors);
    }
  }
}

LightTransport::Ends LightTransport::Shade(const LaneMask& mask, const RayPacket& packet,
                                           const Lanes<float>& before,
                                           const SunRays& sun_rays) const {
  Ends ends;
  ends.side_hit = SidesHit(packet, static_cast<uint32_t>(surfaces_.traced.opaque().size()));
  const LeavesHit leaves = FindLeaves(surfaces_.bake, ends.side_hit, packet);
  for (size_t c = 0; c < channels_.size(); ++c) {
    ends.radiance[c] = AmbientLeaving(surface_light_[c].ambient.data(), leaves);
  }
  if (has_sun_) AddSun(mask, packet, sun_rays, ends);
  if (lamp_dimmer_ > 0.0f && !surfaces_.scene.lamps.empty()) AddLamps(mask, packet, ends);
  if (surfaces_.traced.patterns().any()) ApplyPatterns(mask, packet, before, ends);
  if (sky_varies_) AddSky(mask, packet, ends);
  return ends;
}

LightTransport::Ends LightTransport::TraceOpaque(const LaneMask& mask, RayPacket& packet) const {
  Lanes<float> transmittance;
  transmittance.v.fill(1.0f);
  surfaces_.traced.IntersectThroughPanes(
      mask, packet, Coherence::kCoherent, [&](const LaneMask& panes, const RayPacket& at_panes) {
        const Lanes<float> reflectance = surfaces_.traced.ReflectancesHit(panes, at_panes);
        for (int i = 0; i < kLanes; ++i) transmittance[i] *= 1.0f - reflectance[i];
      });
  Ends ends = Shade(mask, packet, {}, {});
  ends.transmittance = transmittance;
  return ends;
}

LightTransport::Arriving LightTransport::WithKeys(const Ends& ends) const {
  Arriving arriving{.radiance = ends.radiance,
                    .key = LookUp(surfaces_.side_keys.data(), ends.side_hit),
                    .penumbra = ends.penumbra};
  MarkSun(ends.sun, ends.sun_disc, ends.penumbra, arriving.key);
  return arriving;
}

LightTransport::Arriving LightTransport::Trace(const LaneMask& mask, RayPacket& packet,
                                               const SunRays& sun_rays) const {
  const TracedScene& traced = surfaces_.traced;
  bool any_pane = false;
  Lanes<float> throughput;
  std::array<Lanes<float>, kMostChannels> mirrored;
  Lanes<uint32_t> mirror_keys;
  LaneMask penumbra;
  traced.IntersectThroughPanes(
      mask, packet, Coherence::kCoherent, [&](const LaneMask& panes, const RayPacket& at_panes) {
        if (!any_pane) throughput.v.fill(1.0f);
        any_pane = true;
        RayPacket mirror_packet = MirroredRays(panes, at_panes, offset_m_);
        traced.opaque_tracer().Intersect(panes, mirror_packet, Coherence::kCoherent);
        Lanes<float> before;
        std::copy_n(at_panes.ray.tfar, kLanes, before.data());
        const Arriving mirror = WithKeys(Shade(panes, mirror_packet, before, sun_rays));
        const Lanes<float> reflectance = traced.ReflectancesHit(panes, at_panes);
        Lanes<float> mirror_part;
        for (int i = 0; i < kLanes; ++i) mirror_part[i] = throughput[i] * reflectance[i];
        for (size_t c = 0; c < channels_.size(); ++c) {
          AddScaled(mirror.radiance[c], mirror_part, mirrored[c]);
        }
        for (int i = 0; i < kLanes; ++i) {
          throughput[i] -= mirror_part[i];
          if (panes[i] == 0) continue;
          mirror_keys[i] = Mix(mirror_keys[i], mirror.key[i]);
          penumbra[i] |= mirror.penumbra[i];
        }
      });
  Arriving arriving = WithKeys(Shade(mask, packet, {}, sun_rays));
  if (!any_pane) return arriving;
  for (int i = 0; i < kLanes; ++i) {
    for (size_t c = 0; c < channels_.size(); ++c) {
      arriving.radiance[c][i] = mirrored[c][i] + throughput[i] * arriving.radiance[c][i];
    }
    if (mirror_keys[i] != 0) arriving.key[i] = Mix(arriving.key[i], mirror_keys[i]);
    arriving.penumbra[i] |= penumbra[i];
  }
  return arriving;
}

}  // namespace fenestra
