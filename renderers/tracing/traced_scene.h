#pragma once

#include <algorithm>

#include "renderers/tracing/embree_scene.h"
#include "renderers/tracing/surface_patterns.h"
#include "renderers/tracing/triangle_soup.h"
#include "scenes/scene.h"

namespace fenestra {

/// A scene prepared for tracing rays, in three structures: all surfaces, for rays from a viewer;
/// opaque surfaces alone and panes of glass alone, for light on its way to a surface.
class TracedScene {
 public:
  explicit TracedScene(const Scene& scene, InstructionSet instruction_set = InstructionSet::kBest);

  const TriangleSoup& opaque() const { return opaque_; }
  const TriangleSoup& panes() const { return panes_; }
  const SurfacePatterns& patterns() const { return patterns_; }
  const EmbreeScene& all_tracer() const { return all_tracer_; }
  const EmbreeScene& opaque_tracer() const { return opaque_tracer_; }
  bool has_panes() const { return !pane_tracer_.empty(); }

  /// Distance [m] from its surface at which a ray must start so as not to hit the surface again:
  /// some fifty times the rounding error of positions as far out as the scene or the viewer.
  float SurfaceOffset(const glm::vec3& viewer_W) const;

  /// Light that has passed this many panes is not followed further; a house has two in a row.
  static constexpr int kMostPanes = 8;

  /// Distance from which the search goes on behind a pane that was hit at t.
  static float Beyond(float t) { return t + std::max(1e-5f * t, 1e-6f); }

  /// Finds the nearest opaque hit of each lane of the mask, and calls `on_panes(mask, packet)` for
  /// the panes on the way, with the packet as it hits them: from the viewer inwards.
  template <typename OnPanes>
  void IntersectThroughPanes(const LaneMask& mask, RayPacket& packet, Coherence coherence,
                             const OnPanes& on_panes) const;

  /// Share of the light that passes along each ray of the mask up to its tfar: 0 if an opaque
  /// surface is in the way, else the product of the transmittances of all panes. Destroys the rays.
  Lanes<float> Transmittance(const LaneMask& mask, RTCRay16& rays, Coherence coherence) const;

  /// Reflectances of the panes that lanes of the mask have hit; 0 in other lanes.
  Lanes<float> ReflectancesHit(const LaneMask& panes, const RayPacket& packet) const;

 private:
  TriangleSoup opaque_;
  TriangleSoup panes_;
  SurfacePatterns patterns_;
  std::vector<float> pane_index_;
  float extent_m_;
  EmbreeDevice device_;
  EmbreeScene all_tracer_;
  EmbreeScene opaque_tracer_;
  EmbreeScene pane_tracer_;
};

/// Removes all lanes from the mask that have not hit a pane; returns whether any are left.
bool KeepPaneHits(const RayPacket& packet, LaneMask& mask);

/// Makes the rays of the mask go on behind their hits.
void SearchBeyond(const LaneMask& mask, RayPacket& packet);

template <typename OnPanes>
void TracedScene::IntersectThroughPanes(const LaneMask& mask, RayPacket& packet,
                                        Coherence coherence, const OnPanes& on_panes) const {
  all_tracer_.Intersect(mask, packet, coherence);
  if (!has_panes()) return;
  LaneMask active = mask;
  for (int pane = 0; pane < kMostPanes; ++pane) {
    if (!KeepPaneHits(packet, active)) return;
    on_panes(active, packet);
    SearchBeyond(active, packet);
    const EmbreeScene& next = pane + 1 < kMostPanes ? all_tracer_ : opaque_tracer_;
    next.Intersect(active, packet, coherence);
  }
}

}  // namespace fenestra
