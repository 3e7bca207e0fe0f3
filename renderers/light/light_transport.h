#pragma once

#include <array>
#include <vector>

#include "renderers/light/lane_kernels.h"
#include "renderers/light/lit_surfaces.h"
#include "renderers/light/sky_light.h"
#include "renderers/light/sun_points.h"
#include "renderers/tracing/traced_scene.h"

namespace fenestra {

/// The light of a scene under one lighting, as it arrives along rays.
///
/// A ray that meets a surface carries the surface's radiance (see SurfaceLight), with V found by a
/// shadow ray, and the light of the lamps, with one more shadow ray each, all of it multiplied by
/// the surface's pattern. The shadow rays of a packet lead to sixteen points on the rim of the
/// sun's disc. Where some of one surface are blocked and others not, each of its hits sends sixteen
/// more, all over the disc: V is the part of it that is in sight (see SunPoints). A pane of glass
/// before it adds its mirror image, seen without further panes:
///
///     L = (1 − R) L_behind + R L_mirror.
class LightTransport {
 public:
  static constexpr int kMostChannels = 3;

  /// Data that all light transports of one scene have in common.
  struct Surfaces {
    const Scene& scene;
    const TracedScene& traced;
    const LightBake& bake;
    /// A number for each side of each surface, for the sky and for the ground.
    const std::vector<uint32_t>& side_keys;
  };

  /// The origin of rays, and the distance between neighbouring rays: `spread` times their depth.
  struct Viewer {
    glm::vec3 p_WC;
    float spread = 0.0f;
  };

  /// `ambient`: irradiance of the bake's points under this lighting, without light that comes
  /// straight from sun and lamps.
  LightTransport(const Surfaces& surfaces, const std::vector<Spectrum>& ambient,
                 const Lighting& lighting, const std::vector<Channel>& channels,
                 const Viewer& viewer);

  int channel_count() const { return static_cast<int>(channels_.size()); }

  struct Arriving {
    std::array<Lanes<float>, kMostChannels> radiance;
    /// Differs between rays that see different things: another surface, sun instead of shadow, a
    /// pane before the surface, another mirror image in the pane.
    Lanes<uint32_t> key;
    LaneMask penumbra;  ///< Where a part of the sun's disc is hidden.
  };

  /// The part of the sun's disc that each hit looks at.
  struct SunRays {
    /// Of many samples of one thing each may look at one point, since together they see the disc.
    bool one_point = false;
    int packet = 0;  ///< In [0, 16); those of a pixel's packets differ, and so do their points.
  };

  /// Traces fresh rays (see SetRays) in the lanes of the mask; other lanes are undefined.
  Arriving Trace(const LaneMask& mask, RayPacket& packet, const SunRays& sun_rays) const;

  /// The ends of a packet's rays on opaque surfaces, and the light there.
  struct Ends {
    Lanes<uint32_t> side_hit;  ///< See SideIndex.
    std::array<Lanes<float>, kMostChannels> radiance;
    /// The share of the sun's light that arrives through panes: 0 in shadow, on a surface that
    /// faces away, where nothing was hit, and without a sun.
    Lanes<float> sun;
    LaneMask penumbra;           ///< Whether a part of the sun's disc is hidden.
    LaneMask sun_disc;           ///< Whether the ray leads to the sun itself.
    Lanes<float> transmittance;  ///< Transmittance of the panes before the surface.
  };

  /// Traces fresh rays as if panes between the viewer and the surfaces were perfectly clear.
  Ends TraceOpaque(const LaneMask& mask, RayPacket& packet) const;

 private:
  Ends Shade(const LaneMask& mask, const RayPacket& packet, const Lanes<float>& before,
             const SunRays& sun_rays) const;
  Arriving WithKeys(const Ends& ends) const;
  void AddSun(const LaneMask& mask, const RayPacket& packet, const SunRays& sun_rays,
              Ends& ends) const;
  LaneMask Undecided(const LaneMask& towards_sun, const Ends& ends) const;
  void AddLamps(const LaneMask& mask, const RayPacket& packet, Ends& ends) const;
  void AddSky(const LaneMask& mask, const RayPacket& packet, Ends& ends) const;
  void ApplyPatterns(const LaneMask& mask, const RayPacket& packet, const Lanes<float>& before,
                     Ends& ends) const;

  Surfaces surfaces_;
  std::vector<Channel> channels_;
  std::vector<SurfaceLight> surface_light_;             // Per channel.
  std::vector<std::vector<Spectrum>> pattern_weights_;  // Per channel and mesh.
  std::vector<std::vector<Spectrum>> lamp_weights_;     // Per channel and mesh: ρ/π of the lamps.
  SkyLight sky_;
  bool sky_varies_;
  bool has_sun_;
  float lamp_dimmer_;
  glm::vec3 to_sun_W_;
  SunPoints sun_points_;
  float offset_m_;
  float spread_;
};

/// Keys for LightTransport::Surfaces.
std::vector<uint32_t> MakeSideKeys(const std::vector<uint32_t>& surfaces);

}  // namespace fenestra
