#pragma once

#include <array>
#include <vector>

#include "renderers/light/light_bake.h"
#include "renderers/light/spectrum.h"
#include "scenes/lighting.h"

namespace fenestra {

/// Light that reaches the points of a LightBake from sky and ground, and from other surfaces by up
/// to a given number of diffuse bounces. Light that arrives straight from sun and lamps is left to
/// shadow rays. With the vector E of the points' irradiances, the elements' reflectances ρ and
/// exitances M_0 before any bounce, and the form factors G,
///
///     E = E_open + G (M_0 + ρ Ē),   Ē: mean over an element,
///
/// is iterated from E = E_open `bounces` times, or until no value changes by more than 1e-5 of the
/// largest irradiance. The result is linear in each light and computed for a unit of it.
class DiffuseLight {
 public:
  /// Keeps references to all arguments.
  DiffuseLight(const Scene& scene, const TracedScene& traced, const LightBake& bake, int bounces);

  using PointIrradiances = std::vector<Spectrum>;

  /// Irradiances by a sky of horizontal illuminance 1.
  PointIrradiances FromSky(const SkyDome& dome) const;
  /// Irradiances by a ground of exitance 1.
  PointIrradiances FromGround() const;
  /// Irradiances by a sun of illuminance 1 in the direction of the unit vector.
  PointIrradiances FromSun(const glm::vec3& to_sun_W) const;
  /// Irradiances by all lamps, not dimmed.
  PointIrradiances FromLamps() const;
  /// Irradiances by all surfaces that emit light.
  PointIrradiances FromEmission() const;

 private:
  PointIrradiances Bounced(const PointIrradiances& open, const std::vector<Spectrum>& M_0) const;
  struct ElementRays;
  ElementRays RaysFrom(size_t element) const;

  const Scene& scene_;
  const TracedScene& traced_;
  const LightBake& bake_;
  int bounces_;
  std::vector<Spectrum> reflectances_;  // Of each element.
  std::vector<Spectrum> emissions_;     // Exitance of each element.
};

/// The irradiance of a lamp of 1 cd on a surface at p with the unit normal n, if nothing is in the
/// way; 0 behind the surface.
float LampIrradiance(const Lamp& lamp, const glm::vec3& p_W, const glm::vec3& n_W);

}  // namespace fenestra
