#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderers/light/bake_rays.h"
#include "renderers/light/light_elements.h"
#include "renderers/light/light_patches.h"
#include "renderers/light/sky_light.h"
#include "renderers/tracing/traced_scene.h"

namespace fenestra {

/// What a point sees of one patch of the sky: with its luminance L as a function of the direction d
/// and cos θ = n·d, its part of the irradiance is ∫ L cos θ dω, of which a linear L needs no more
/// than these.
struct SkyPart {
  uint32_t patch = 0;
  float w = 0.0f;         ///< ∫ cos θ dω [sr] over what is seen of the patch.
  glm::vec3 sum_W{0.0f};  ///< ∫ d cos θ dω over the same.
};

/// What a point sees of the sky, as daylight coefficients of its patches, and of the ground.
struct OpenView {
  std::vector<SkyPart> sky;  ///< In the order of the patches.
  float ground = 0.0f;
};

/// What a point sees of an element.
struct FormFactor {
  uint32_t element = 0;
  float w = 0.0f;
};

/// All that a point sees: see LightBake.
struct HemisphereView {
  OpenView open;
  std::vector<FormFactor> factors;  ///< One per element, in the order of the elements.
  /// Mean of the inverse square of the distance of all that is seen, 0 for what is open, weighted
  /// as it lights the point: about the largest curvature that light can have there, as a part of
  /// the light of a surface that fills the view.
  float curvature_per_m2 = 0.0f;
};

/// Casts the rays of a LightBake.
class HemisphereCaster {
 public:
  /// Keeps references to all arguments.
  HemisphereCaster(const TracedScene& scene, const LightPatches& patches, LightElements& elements);

  /// What is seen from the point: along one ray into each cell of the hemisphere, and along sixteen
  /// into those whose neighbours end differently, or 64 where these are few. Makes the elements
  /// that are seen.
  HemisphereView From(const BakePoint& point);

  /// The view if nothing stood before the point.
  OpenView Unobstructed(const BakePoint& point) const;

  /// How many of sixteen rays from a point meet the backs of bodies (see BoundBodies), and how many
  /// end within a distance.
  struct Surroundings {
    int backs = 0;
    int near = 0;

    /// No viewer can see the point, so that its light is none for what can be seen beside it: it
    /// lies inside a body or under something that lies on its surface.
    ///
    /// Texels of lightmaps are judged likewise by the share of their rays that meet backs
    /// ("backface tolerance" in Unity's manual), and filled from their valid neighbours.
    bool IsHidden() const;
    /// Nothing keeps light from the point that does not reach farther than the distance.
    bool IsFree() const;
  };
  Surroundings About(const BakePoint& point, float near_m) const;

  bool BoundsBody(uint32_t triangle) const { return bounds_body_[triangle]; }

  /// Distance from a surface at which rays start.
  float offset_m() const { return offset_m_; }

 private:
  struct Ending;
  class Tally;

  std::vector<Ending> CastTiles(const BakePoint& point) const;
  std::array<Ending, kLanes> Cast(const BakePoint& point, const DirectionSquare& square) const;

  const TracedScene& scene_;
  const LightPatches& patches_;
  LightElements& elements_;
  float offset_m_;
  HemisphereDirections directions_;
  std::vector<bool> bounds_body_;  // Of each opaque triangle.
};

}  // namespace fenestra
