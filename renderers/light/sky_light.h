#pragma once

#include <glm/vec3.hpp>

#include "renderers/light/spectrum.h"
#include "scenes/lighting.h"
#include "scenes/sky_dome.h"

namespace fenestra {

/// What a ray sees that leaves the scene upwards: the sky, and the sun's disc before it. The disc
/// has the sun's illuminance spread evenly over its solid angle.
class SkyLight {
 public:
  explicit SkyLight(const Lighting& lighting);

  struct Seen {
    Spectrum radiance{0.0f};
    bool sun = false;  ///< The disc is in this direction.
  };

  /// The direction need not be normalised; y > 0.
  Seen Towards(const glm::vec3& direction_W) const;

 private:
  SkyDome dome_;
  Eigen::Vector3d to_sun_W_;
  Spectrum sky_;
  Spectrum disc_;
};

}  // namespace fenestra
