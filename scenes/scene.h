#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.h"

namespace fenestra {

/// How a surface treats light. Every surface has separate reflectances in the visible and at
/// 830 nm, the structured-light projector's wavelength: a black paint may be bright there.
struct Material {
  enum class Kind {
    kLambert,  ///< Radiance = reflectance · irradiance / π, the same in all directions.
    kGlass,    ///< A thin clear pane: Fresnel mirror and transmission, no scattering.
  };

  std::string name;
  Kind kind = Kind::kLambert;
  glm::vec3 reflectance_rgb{0.0f};  ///< Lambert only; linear, each in [0, 1].
  float reflectance_830nm = 0.0f;   ///< Lambert only; in [0, 1].
  float refractive_index = 1.52f;   ///< Glass only; 1.52: soda-lime float glass.
};

/// Triangles of one object and one material. A surface is two-sided unless it is closed.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions_W;  ///< [m]
  std::vector<glm::uvec3> triangles;   ///< Indices into positions_W.
  uint32_t material = 0;               ///< Index into Scene::materials.
  /// Bounds a solid body on whose inside no light falls; triangles wind counter-clockwise as seen
  /// from outside.
  bool closed = false;
};

/// The window whose truth is scored. Frame O: origin at the centre of the frame's front outer
/// rectangle, +x to the viewer's right, +y up, +z out of the wall towards the viewer.
struct TargetWindow {
  Pose X_WO;
  double width_m = 0.0;   ///< Outer width of the frame.
  double height_m = 0.0;  ///< Outer height of the frame.

  /// Corners of the front outer rectangle: top left, top right, bottom right, bottom left as a
  /// viewer in front of the window sees them.
  std::array<Eigen::Vector3d, 4> Corners_W() const;
  Eigen::Vector3d Centroid_W() const { return X_WO.translation(); }
};

/// What stands in the world. World frame W: right-handed, +Y up, metres; the facade's outer face is
/// the plane z = 0, its outward normal +Z. A mesh's index is its object id.
struct Scene {
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::optional<TargetWindow> target;  ///< Absent in a scene without a window.
  /// Other windows: a detection of one of them is a `wrong_window`.
  std::vector<TargetWindow> other_windows;
};

/// Throws InputError unless all indices are in range, all numbers finite and reflectances in
/// [0, 1].
void Validate(const Scene& scene);

}  // namespace fenestra
