#pragma once

#include <array>
#include <vector>

#include "renderers/lane_kernels.h"
#include "renderers/lit_surfaces.h"
#include "renderers/traced_scene.h"

namespace fenestra {

/// The light of a scene under one lighting: what arrives along rays.
///
/// Along a ray that meets a surface arrives the surface's radiance (see SideRadiance) with V found
/// by a shadow ray. A pane of glass before it adds its mirror image, seen without further panes:
///
///     L = (1 − R) L_behind + R L_mirror.
class LightTransport {
 public:
  static constexpr int kMostChannels = 3;

  /// What all light transports of one scene have in common.
  struct Surfaces {
    const Scene& scene;
    const TracedScene& traced;
    const std::vector<TriangleSkyView>& sky_views;
    /// A number for each side of each plane of each mesh, for the sky and for the ground.
    const std::vector<uint32_t>& side_keys;
  };

  LightTransport(const Surfaces& surfaces, const Lighting& lighting,
                 const std::vector<Channel>& channels, const glm::vec3& viewer_W);

  int channel_count() const { return static_cast<int>(sides_.size()); }

  struct Arriving {
    std::array<Lanes<float>, kMostChannels> radiance;
    /// Different where something else is seen: another object or plane, sun instead of shadow, a
    /// pane before it, another mirror image in the pane.
    Lanes<uint32_t> key;
  };

  /// Traces fresh rays (see SetRays) in the lanes of the mask; other lanes are undefined.
  Arriving Trace(const LaneMask& mask, RayPacket& packet) const;

  /// Where a packet's rays end on opaque surfaces, and the light there.
  struct Ends {
    Lanes<uint32_t> side_hit;  ///< See SideIndex.
    std::array<Lanes<float>, kMostChannels> radiance;
    /// The part of the sun's light that arrives, panes considered: 0 in the shadow, where the
    /// surface faces away, where nothing was hit and without a sun.
    Lanes<float> sun;
  };

  /// Traces fresh rays as if there were no panes between the viewer and the surfaces.
  Ends TraceOpaque(const LaneMask& mask, RayPacket& packet) const;

 private:
  Arriving WithKeys(const Ends& ends) const;
  Lanes<float> SunReaching(const LaneMask& mask, const RayPacket& packet,
                           const Lanes<float>& sun_facing) const;
  void LookThroughPanes(const LaneMask& mask, const RayPacket& packet, Arriving& arriving) const;

  Surfaces surfaces_;
  std::vector<std::vector<SideRadiance>> sides_;  ///< Per channel.
  bool has_sun_;
  glm::vec3 to_sun_W_;
  float offset_m_;
};

/// Keys for LightTransport::Surfaces.
std::vector<uint32_t> MakeSideKeys(const TriangleSoup& soup);

}  // namespace fenestra
