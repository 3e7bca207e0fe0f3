#pragma once

#include <Eigen/Core>

#include "core/geometry/pose.h"

namespace fenestra {

/// Daylight's spectral irradiance at 830 nm per lux of illuminance [W/(m² nm lx)].
/// Source: ASTM G173-03, 825–835 nm mean of the direct beam 0.87 W/(m² nm), at about 103 klx.
inline constexpr double kDaylightIrradiance830PerLux = 0.87 / 103e3;

/// A distant disc of even brightness: at a distance z behind what casts it, a shadow's edge is as
/// wide as z times the disc's diameter: 1 mm where it falls 10 cm behind.
struct Sun {
  double azimuth_rad = 0.0;               ///< From the facade's normal (+Z) towards +X.
  double elevation_rad = 40.0 * kDegree;  ///< Above the horizon.
  double illuminance_lx = 0.0;            ///< On a plane perpendicular to the rays; 0: no sun.
  /// Apparent diameter, in the mean 2 · 959.6″ (Astronomical Almanac); 0: hard shadows.
  double angular_diameter_rad = 9.3e-3;

  /// Unit vector from the scene to the sun.
  Eigen::Vector3d Direction_W() const;
};

/// A sky dome above the horizon and, below it, a Lambert ground that sky and sun light.
struct Sky {
  /// Distribution of luminance over the dome; see SkyDome.
  enum class Model {
    kUniform,
    kCieOvercast,  ///< Three times as bright at the zenith as at the horizon.
    kCieClear,  ///< Brightest around the sun, whose position counts even if its illuminance is 0.
  };
  Model model = Model::kUniform;
  double illuminance_lx = 500.0;    ///< On an unobstructed horizontal plane.
  double ground_reflectance = 0.2;  ///< Reflectance of the unobstructed ground.
};

/// All light of a scene; radiance is linear in each illuminance. `irradiance_830_per_lux` turns
/// the illuminance of sun and sky into spectral irradiance at 830 nm: daylight by default.
struct Lighting {
  Sun sun;
  Sky sky;
  double irradiance_830_per_lux = kDaylightIrradiance830PerLux;
  double lamp_dimmer = 1.0;  ///< Multiplies the light of all lamps of the scene; 0: off.
};

/// Throws InputError, with all faults, unless all numbers are finite, illuminances and the dimmer
/// not negative and the ground's reflectance is in [0, 1].
void Validate(const Lighting& lighting);

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
