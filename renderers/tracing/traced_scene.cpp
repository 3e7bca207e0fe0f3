#include "renderers/tracing/traced_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/system/wide.h"
#include "renderers/tracing/pane_kernels.h"

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

EmbreeScene::Part SolidPart(const TriangleSoup& soup) {
  return {.soup = soup, .id = kOpaqueGeometry, .first = 0, .count = soup.solid_count};
}
EmbreeScene::Part HoledPart(const TriangleSoup& soup) {
  return {.soup = soup,
          .id = kHoledGeometry,
          .first = soup.solid_count,
          .count = soup.size() - soup.solid_count};
}
EmbreeScene::Part PanePart(const TriangleSoup& soup) {
  return {.soup = soup, .id = kPaneGeometry, .first = 0, .count = soup.size()};
}

}  // namespace

TracedScene::TracedScene(const Scene& scene, InstructionSet instruction_set)
    : opaque_(MakeTriangleSoup(scene, Material::Kind::kLambert)),
      panes_(MakeTriangleSoup(scene, Material::Kind::kGlass)),
      patterns_(scene, opaque_),
      pane_index_(RefractiveIndices(scene, panes_)),
      extent_m_(std::max(LargestCoordinate(opaque_), LargestCoordinate(panes_))),
      device_(instruction_set),
      all_tracer_(device_, std::array{SolidPart(opaque_), HoledPart(opaque_), PanePart(panes_)},
                  patterns_),
      opaque_tracer_(device_, std::array{SolidPart(opaque_), HoledPart(opaque_)}, patterns_),
      pane_tracer_(device_, std::array{PanePart(panes_)}, patterns_) {}

float TracedScene::SurfaceOffset(const glm::vec3& viewer_W) const {
  const float viewer_m =
      std::max({std::abs(viewer_W.x), std::abs(viewer_W.y), std::abs(viewer_W.z)});
  return 64.0f * std::numeric_limits<float>::epsilon() * std::max(extent_m_, viewer_m);
}

Lanes<float> TracedScene::ReflectancesHit(const LaneMask& panes, const RayPacket& packet) const {
  return PaneReflectances(panes, packet, pane_index_.data());
}

// The mask is changed in place: GCC 12 does not always align the temporary that a 64-byte aligned
// result is returned in.
FENESTRA_WIDE bool KeepPaneHits(const RayPacket& packet, LaneMask& mask) {
  int any = 0;
  for (int i = 0; i < kLanes; ++i) {
    mask[i] &= packet.hit.geomID[i] == kPaneGeometry ? -1 : 0;
    any |= mask[i];
  }
  return any != 0;
}

FENESTRA_WIDE void SearchBeyond(const LaneMask& mask, RayPacket& packet) {
  RTCRay16& ray = packet.ray;
  RTCHit16& hit = packet.hit;
  for (int i = 0; i < kLanes; ++i) {
    const bool on = mask[i] != 0;
    ray.tnear[i] = on ? TracedScene::Beyond(ray.tfar[i]) : ray.tnear[i];
    ray.tfar[i] = on ? std::numeric_limits<float>::infinity() : ray.tfar[i];
    hit.Ng_x[i] = on ? 0.0f : hit.Ng_x[i];
    hit.Ng_y[i] = on ? -1.0f : hit.Ng_y[i];
    hit.Ng_z[i] = on ? 0.0f : hit.Ng_z[i];
    hit.u[i] = on ? 0.0f : hit.u[i];
    hit.v[i] = on ? 0.0f : hit.v[i];
    hit.primID[i] = on ? RTC_INVALID_GEOMETRY_ID : hit.primID[i];
    hit.geomID[i] = on ? RTC_INVALID_GEOMETRY_ID : hit.geomID[i];
  }
}

Lanes<float> TracedScene::Transmittance(const LaneMask& mask, RTCRay16& rays,
                                        Coherence coherence) const {
  RayPacket packet;
  if (has_panes()) packet.ray = rays;
  opaque_tracer_.Occlude(mask, rays, coherence);
  LaneMask open;
  Lanes<float> passed;
  bool any = false;
  for (int i = 0; i < kLanes; ++i) {
    open[i] = mask[i] & (rays.tfar[i] >= 0.0f ? -1 : 0);
    passed[i] = open[i] != 0 ? 1.0f : 0.0f;
    any = any || open[i] != 0;
  }
  if (!has_panes() || !any) return passed;
  for (int pane = 0; pane < kMostPanes; ++pane) {
    std::fill_n(packet.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    pane_tracer_.Intersect(open, packet, coherence);
    if (!KeepPaneHits(packet, open)) break;
    const Lanes<float> reflectance = ReflectancesHit(open, packet);
    for (int i = 0; i < kLanes; ++i) {
      if (open[i] == 0) continue;
      passed[i] *= 1.0f - reflectance[i];
      packet.ray.tnear[i] = Beyond(packet.ray.tfar[i]);
      packet.ray.tfar[i] = rays.tfar[i];
    }
  }
  return passed;
}

}  // namespace fenestra
