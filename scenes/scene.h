#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/pose.h"

namespace fenestra {

/// A picture on a surface. Red, green and blue are sRGB-encoded; alpha is linear.
struct Texture {
  /// The continuation of a texture beyond coordinates of [0, 1].
  enum class Wrap { kRepeat, kMirroredRepeat, kClampToEdge };

  std::string name{};
  int width_px = 0;
  int height_px = 0;
  std::vector<glm::u8vec4> texels{};  ///< Row-major from the top left; width_px · height_px.
  Wrap wrap_u = Wrap::kRepeat;
  Wrap wrap_v = Wrap::kRepeat;
  /// true: linear values are interpolated between texel centres; false: the nearest texel counts.
  bool interpolated = true;
};

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

/// Optical properties of a surface. Reflectances in the visible and at 830 nm, the wavelength of
/// structured-light projectors, are separate: a black paint may be bright there.
struct Material {
  enum class Kind {
    /// Radiance = emission + reflectance · irradiance / π, the same in all directions.
    kLambert,
    kGlass,  ///< A thin clear pane: Fresnel mirror and transmission, no scattering.
  };

  std::string name;
  Kind kind = Kind::kLambert;
  glm::vec3 reflectance_rgb{0.0f};  ///< Lambert only; linear, each in [0, 1].
  float reflectance_830nm = 0.0f;   ///< Lambert only; in [0, 1].
  float refractive_index = 1.52f;   ///< Glass only; 1.52: soda-lime float glass.
  glm::vec3 emission_rgb{0.0f};  ///< Lambert only; own radiance of both sides [cd/m²], 0 or more.
  float emission_830nm = 0.0f;   ///< Lambert only; own radiance at 830 nm [W/(m² sr nm)].
  /// Index into Scene::textures; Lambert only. Multiplies reflectance and emission: in the visible
  /// per colour, at 830 nm by its luminance. Without texture coordinates a mesh has no texture.
  std::optional<uint32_t> texture{};
  /// The surface has a hole where the texture's alpha is below this; 0: no holes.
  float alpha_cutoff = 0.0f;
};

/// Triangles of one object and one material. A surface is two-sided unless it is closed.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions_W{};  ///< [m]
  std::vector<glm::uvec3> triangles{};   ///< Indices into positions_W.
  uint32_t material = 0;                 ///< Index into Scene::materials.
  /// Bounds a solid body on whose inside no light falls; triangles wind counter-clockwise as seen
  /// from outside.
  bool closed = false;
  /// One per position, or none. (0, 0) is the texture's top left corner, (1, 1) its bottom right.
  std::vector<glm::vec2> texture_coordinates{};
  /// One per position, or none: multiplies reflectance and emission; linear, each in [0, 1].
  std::vector<glm::vec3> colors{};
  /// One unit vector per position, or none: a smooth surface that the triangles approximate. They
  /// shade; shadows and silhouettes are those of the triangles.
  std::vector<glm::vec3> normals_W{};
};

/// The window whose truth is scored. Frame O: origin at the centre of the window frame's front
/// outer rectangle, +x to the viewer's right, +y up, +z out of the wall towards the viewer.
struct TargetWindow {
  Pose X_WO;
  double width_m = 0.0;   ///< Outer width of the window frame.
  double height_m = 0.0;  ///< Outer height of the window frame.

  /// Corners of the front outer rectangle: top left, top right, bottom right, bottom left as a
  /// viewer in front of the window sees them.
  std::array<Eigen::Vector3d, 4> Corners_W() const;
  Eigen::Vector3d Centroid_W() const { return X_WO.translation(); }
};

/// The contents of the world. World frame W: right-handed, +Y up, metres; the facade's outer face
/// is the plane z = 0, its outward normal +Z. A mesh's index is its object id.
struct Scene {
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Texture> textures;
  std::vector<Lamp> lamps;
  std::optional<TargetWindow> target;  ///< Absent in a scene without a window.
  /// Other windows: a detection of one of them is a `wrong_window`.
  std::vector<TargetWindow> other_windows;
};

/// Throws InputError, with all faults, unless all indices are in range, all numbers finite,
/// reflectances in [0, 1], emissions and intensities 0 or more, and the data per position complete.
void Validate(const Scene& scene);

}  // namespace fenestra
