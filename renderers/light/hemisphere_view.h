#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderers/light/bake_rays.h"
#include "renderers/light/sky_light.h"
#include "renderers/tracing/traced_scene.h"

namespace fenestra {

/// What a point sees of the sky, as daylight coefficients of its patches, and of the ground.
struct OpenView {
  std::array<float, kSkyPatches> sky{};
  float ground = 0.0f;
};

/// What a point sees of one side of a triangle (see SideIndex).
struct FormFactor {
  uint32_t side = 0;
  float w = 0.0f;
};

/// All that a point sees: see LightBake.
struct HemisphereView {
  OpenView open;
  std::vector<FormFactor> factors;  ///< One per side, in the order of the sides.
};

/// Casts the rays of a LightBake.
class HemisphereCaster {
 public:
  /// Keeps a reference to the scene.
  explicit HemisphereCaster(const TracedScene& scene);

  /// What is seen from the point: along one ray into each cell of the hemisphere, and along sixteen
  /// into those whose neighbours end differently.
  HemisphereView From(const BakePoint& point) const;

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

 private:
  struct Ending;
  class Tally;

  std::vector<Ending> CastTiles(const BakePoint& point) const;
  std::array<Ending, kLanes> Cast(const BakePoint& point, const DirectionSquare& square) const;

  const TracedScene& scene_;
  float offset_m_;
  HemisphereDirections directions_;
  std::vector<bool> bounds_body_;  // Of each opaque triangle.
};

}  // namespace fenestra
