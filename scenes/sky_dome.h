#pragma once

#include <Eigen/Core>

#include "scenes/lighting.h"

namespace fenestra {

/// Luminance L of the sky above the horizon, white, as a multiple of its horizontal illuminance
/// E_h. γ: elevation of the direction; g: its angle to the sun; L_z: a scale that makes
/// ∫ L sin γ dω = E_h.
///
///     uniform       L = L_z
///     CIE overcast  L = L_z (1 + 2 sin γ)/3,                     E_h = 7 π L_z / 9
///     CIE clear     L = L_z (0.91 + 10 e^(−3 g) + 0.45 cos² g)(1 − e^(−0.32 / sin γ))
///
/// Sources: P. Moon and D. E. Spencer, 1942; R. Kittler, 1967; both CIE S 003.
class SkyDome {
 public:
  /// `to_sun_W` is used by the clear sky only; a unit vector.
  SkyDome(Sky::Model model, const Eigen::Vector3d& to_sun_W);

  /// L/E_h [1/sr] in a unit direction with y > 0.
  double LuminancePerLux(const Eigen::Vector3d& direction_W) const;

 private:
  double Relative(const Eigen::Vector3d& direction_W) const;

  Sky::Model model_;
  Eigen::Vector3d to_sun_W_;
  double scale_ = 1.0;
};

}  // namespace fenestra
