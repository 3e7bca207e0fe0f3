#pragma once

#include <algorithm>

#include "renderers/embree_scene.h"
#include "renderers/triangle_soup.h"
#include "scenes/scene.h"

namespace fenestra {

/// A scene made ready for rays: opaque surfaces, and panes of glass kept apart from them, since
/// almost all rays ask what stands behind a pane.
class TracedScene {
 public:
  explicit TracedScene(const Scene& scene);

  const TriangleSoup& opaque() const { return opaque_; }
  const TriangleSoup& panes() const { return panes_; }
  const EmbreeScene& opaque_tracer() const { return opaque_tracer_; }
  const EmbreeScene& pane_tracer() const { return pane_tracer_; }
  bool has_panes() const { return !pane_tracer_.empty(); }
  float refractive_index(uint32_t pane_triangle) const { return pane_index_[pane_triangle]; }

  /// How far [m] a ray must start off the surface of its origin so as not to hit it again: some
  /// fifty times the rounding error of positions as far out as the scene or the viewer.
  float SurfaceOffset(const glm::vec3& viewer_W) const;

  /// Light that has passed this many panes is not followed further; a house has two in a row.
  static constexpr int kMostPanes = 8;

  /// Where to search on behind a pane that was hit at t.
  static float Beyond(float t) { return t + std::max(1e-5f * t, 1e-6f); }

  /// What of the light passes along each ray of the mask up to its tfar: 0 if an opaque surface is
  /// in the way, else the product of the transmittances of all panes. Destroys the rays.
  Lanes<float> Transmittance(const LaneMask& mask, RTCRay16& rays, Coherence coherence) const;

  /// The same for panes alone.
  Lanes<float> PaneTransmittance(const LaneMask& mask, const RTCRay16& rays,
                                 Coherence coherence) const;

 private:
  TriangleSoup opaque_;
  TriangleSoup panes_;
  std::vector<float> pane_index_;
  float extent_m_;
  EmbreeDevice device_;
  EmbreeScene opaque_tracer_;
  EmbreeScene pane_tracer_;
};

/// |cos| of the angle between the ray of a lane and the normal of what it hit.
float HitCosine(const RayPacket& packet, int lane);

}  // namespace fenestra
