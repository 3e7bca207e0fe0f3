#include "renderers/traced_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/fresnel.h"

namespace fenestra {
namespace {

std::vector<float> RefractiveIndices(const Scene& scene, const TriangleSoup& panes) {
  std::vector<float> indices;
  indices.reserve(panes.size());
  for (const uint32_t mesh : panes.mesh_of) {
    indices.push_back(scene.materials[scene.meshes[mesh].material].refractive_index);
  }
  return indices;
}

float LargestCoordinate(const TriangleSoup& soup) {
  float largest = 0.0f;
  for (const glm::vec3& p : soup.positions_W) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest;
}

bool AnyHit(const LaneMask& mask) {
  return std::any_of(mask.v.begin(), mask.v.end(), [](int m) { return m != 0; });
}

}  // namespace

float HitCosine(const RayPacket& packet, int lane) {
  const RTCHit16& h = packet.hit;
  const RTCRay16& r = packet.ray;
  const float nn =
      h.Ng_x[lane] * h.Ng_x[lane] + h.Ng_y[lane] * h.Ng_y[lane] + h.Ng_z[lane] * h.Ng_z[lane];
  const float dd =
      r.dir_x[lane] * r.dir_x[lane] + r.dir_y[lane] * r.dir_y[lane] + r.dir_z[lane] * r.dir_z[lane];
  const float nd =
      h.Ng_x[lane] * r.dir_x[lane] + h.Ng_y[lane] * r.dir_y[lane] + h.Ng_z[lane] * r.dir_z[lane];
  return std::abs(nd) / std::sqrt(nn * dd);
}

TracedScene::TracedScene(const Scene& scene)
    : opaque_(MakeTriangleSoup(scene, Material::Kind::kLambert)),
      panes_(MakeTriangleSoup(scene, Material::Kind::kGlass)),
      pane_index_(RefractiveIndices(scene, panes_)),
      extent_m_(std::max(LargestCoordinate(opaque_), LargestCoordinate(panes_))),
      opaque_tracer_(device_, opaque_),
      pane_tracer_(device_, panes_) {}

float TracedScene::SurfaceOffset(const glm::vec3& viewer_W) const {
  const float viewer_m =
      std::max({std::abs(viewer_W.x), std::abs(viewer_W.y), std::abs(viewer_W.z)});
  return 64.0f * std::numeric_limits<float>::epsilon() * std::max(extent_m_, viewer_m);
}

Lanes<float> TracedScene::PaneTransmittance(const LaneMask& mask, const RTCRay16& rays,
                                            Coherence coherence) const {
  Lanes<float> passed;
  passed.v.fill(1.0f);
  if (!has_panes()) return passed;
  RayPacket packet;
  packet.ray = rays;
  LaneMask active = mask;
  for (int pane = 0; pane < kMostPanes && AnyHit(active); ++pane) {
    std::fill_n(packet.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    pane_tracer_.Intersect(active, packet, coherence);
    for (int i = 0; i < kLanes; ++i) {
      if (active[i] == 0) continue;
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
        active[i] = 0;
        continue;
      }
      passed[i] *=
          1.0f - PaneReflectance(HitCosine(packet, i), refractive_index(packet.hit.primID[i]));
      packet.ray.tnear[i] = Beyond(packet.ray.tfar[i]);
      packet.ray.tfar[i] = rays.tfar[i];
    }
  }
  return passed;
}

Lanes<float> TracedScene::Transmittance(const LaneMask& mask, RTCRay16& rays,
                                        Coherence coherence) const {
  Lanes<float> tfar;
  std::copy_n(rays.tfar, kLanes, tfar.data());
  opaque_tracer_.Occlude(mask, rays, coherence);
  LaneMask open;
  Lanes<float> passed;
  for (int i = 0; i < kLanes; ++i) {
    open[i] = mask[i] != 0 && rays.tfar[i] >= 0.0f ? -1 : 0;
    passed[i] = open[i] != 0 ? 1.0f : 0.0f;
  }
  if (!has_panes() || !AnyHit(open)) return passed;
  std::copy_n(tfar.data(), kLanes, rays.tfar);
  const Lanes<float> through_panes = PaneTransmittance(open, rays, coherence);
  for (int i = 0; i < kLanes; ++i) passed[i] *= through_panes[i];
  return passed;
}

}  // namespace fenestra
