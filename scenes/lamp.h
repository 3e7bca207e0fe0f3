#pragma once

#include <Eigen/Core>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <string>

namespace fenestra {

/// A small lamp: its illuminance falls with the square of the distance r, E = I cos θ / r², and its
/// shadows are hard. Shines in all directions, or in a cone with a soft rim.
struct Lamp {
  std::string name{};
  Eigen::Vector3d p_WL = Eigen::Vector3d::Zero();
  glm::vec3 intensity_rgb{0.0f};  ///< I [cd], 0 or more.
  /// Spectral irradiance at 830 nm per lux [W/(m² nm lx)] of the luminance of intensity_rgb. 0: an
  /// LED lamp.
  double irradiance_830_per_lux = 0.0;

  /// Full intensity within the inner angle from the axis, none from the outer one on, and between
  /// them, as KHR_lights_punctual has it,
  ///
  ///     I(θ) = I · clamp((cos θ − cos outer) / (cos inner − cos outer), 0, 1)².
  struct Cone {
    Eigen::Vector3d axis_W = -Eigen::Vector3d::UnitY();  ///< Unit vector, away from the lamp.
    double inner_rad = 0.0;                              ///< In [0, outer).
    double outer_rad = std::numbers::pi / 4.0;           ///< At most π / 2.
  };
  std::optional<Cone> cone{};
};

}  // namespace fenestra
