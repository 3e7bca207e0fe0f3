#pragma once

#include <Eigen/Core>
#include <array>
#include <glm/vec3.hpp>

#include "renderers/light/spectrum.h"
#include "scenes/lighting.h"

namespace fenestra {

/// The sky and, before it, the sun's disc, as rays see them that leave the scene upwards. The sun's
/// illuminance is spread evenly over the disc's solid angle.
class SkyLight {
 public:
  explicit SkyLight(const Lighting& lighting);

  struct Seen {
    Spectrum radiance{0.0f};
    bool sun = false;  ///< Whether the disc is in this direction.
  };

  /// The direction need not be normalised; y > 0.
  Seen Towards(const glm::vec3& direction_W) const;

 private:
  SkyDome dome_;
  Eigen::Vector3d to_sun_W_;
  Spectrum sky_;
  Spectrum disc_{0.0f};
  double chord_;  // From the disc's centre to its rim, on the unit sphere.
};

/// The sky in patches of about equal solid angle: seven bands of 12 degrees and a cap at the
/// zenith. Source: P. R. Tregenza, "Subdivision of the sky hemisphere for luminance measurements",
/// 1987.
inline constexpr int kSkyPatches = 145;

/// The patch of a unit direction with y ≥ 0.
int SkyPatchOf(const glm::vec3& direction_W);

/// The luminance over one patch, as a linear function of the unit direction d.
struct PatchLuminance {
  double mean = 0.0;                                   ///< Of L/E_h [1/sr].
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< Mean of d.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< L/E_h ≈ mean + gradient·(d − centre).
};
std::array<PatchLuminance, kSkyPatches> PatchLuminances(const SkyDome& dome);

}  // namespace fenestra
