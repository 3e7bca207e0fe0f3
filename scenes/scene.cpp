#include "scenes/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/io/faults.h"

namespace fenestra {
namespace {

bool InUnitInterval(float x) {
  return x >= 0.0f && x <= 1.0f;  // False for NaN.
}

bool IsFinite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool IsLight(float x) {
  return std::isfinite(x) && x >= 0.0f;
}

void CheckMaterial(const Material& material, size_t index, size_t texture_count, Faults& faults) {
  const auto demand = [&](bool holds, const char* message) {
    faults.Require(holds, fmt::format("material {} '{}': {}", index, material.name, message));
  };
  if (material.kind == Material::Kind::kGlass) {
    demand(std::isfinite(material.refractive_index) && material.refractive_index >= 1.0f,
           "the refractive index must be 1 or more");
    return;
  }
  const glm::vec3& rgb = material.reflectance_rgb;
  demand(InUnitInterval(rgb.r) && InUnitInterval(rgb.g) && InUnitInterval(rgb.b) &&
             InUnitInterval(material.reflectance_830nm),
         "reflectances must be in [0, 1]");
  const glm::vec3& emission = material.emission_rgb;
  demand(IsLight(emission.r) && IsLight(emission.g) && IsLight(emission.b) &&
             IsLight(material.emission_830nm),
         "emissions must be 0 or more");
  demand(InUnitInterval(material.alpha_cutoff), "the alpha cutoff must be in [0, 1]");
  demand(!material.texture || *material.texture < texture_count, "its texture does not exist");
}

void CheckTexture(const Texture& texture, size_t index, Faults& faults) {
  faults.Require(texture.width_px > 0 && texture.height_px > 0 &&
                     texture.texels.size() == static_cast<size_t>(texture.width_px) *
                                                  static_cast<size_t>(texture.height_px),
                 fmt::format("texture {} '{}': {} texels do not make {} x {}", index, texture.name,
                             texture.texels.size(), texture.width_px, texture.height_px));
}

void CheckLamp(const Lamp& lamp, size_t index, Faults& faults) {
  const auto demand = [&](bool holds, const char* message) {
    faults.Require(holds, fmt::format("lamp {} '{}': {}", index, lamp.name, message));
  };
  const glm::vec3& I = lamp.intensity_rgb;
  demand(lamp.p_WL.allFinite(), "its position must be finite");
  demand(IsLight(I.r) && IsLight(I.g) && IsLight(I.b) &&
             std::isfinite(lamp.irradiance_830_per_lux) && lamp.irradiance_830_per_lux >= 0.0,
         "intensities must be 0 or more");
  if (!lamp.cone) return;
  constexpr double kUnitTolerance = 1e-6;
  demand(std::abs(lamp.cone->axis_W.norm() - 1.0) < kUnitTolerance,
         "its axis must be a unit vector");
  demand(lamp.cone->inner_rad >= 0.0 && lamp.cone->inner_rad < lamp.cone->outer_rad &&
             lamp.cone->outer_rad <= 0.5 * std::numbers::pi,
         "the cone's angles must be 0 <= inner < outer <= 90 degrees");
}

void CheckMesh(const Mesh& mesh, size_t index, size_t material_count, Faults& faults) {
  const auto demand = [&](bool holds, const char* message) {
    faults.Require(holds, fmt::format("mesh {} '{}': {}", index, mesh.name, message));
  };
  demand(mesh.material < material_count, "its material does not exist");
  demand(std::ranges::all_of(mesh.positions_W, IsFinite), "positions must be finite");
  const auto complete = [&mesh](const auto& values) {
    return values.empty() || values.size() == mesh.positions_W.size();
  };
  demand(complete(mesh.texture_coordinates) && complete(mesh.colors) && complete(mesh.normals_W),
         "texture coordinates, colours and normals must be one per position or none");
  demand(std::ranges::all_of(
             mesh.texture_coordinates,
             [](const glm::vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }),
         "texture coordinates must be finite");
  demand(std::ranges::all_of(mesh.colors,
                             [](const glm::vec3& c) {
                               return InUnitInterval(c.r) && InUnitInterval(c.g) &&
                                      InUnitInterval(c.b);
                             }),
         "colours must be in [0, 1]");
  constexpr float kUnitTolerance = 1e-3f;
  demand(std::ranges::all_of(
             mesh.normals_W,
             [](const glm::vec3& n) { return std::abs(glm::length(n) - 1.0f) < kUnitTolerance; }),
         "normals must be unit vectors");
  const size_t count = mesh.positions_W.size();
  demand(std::ranges::all_of(
             mesh.triangles,
             [count](const glm::uvec3& t) { return t.x < count && t.y < count && t.z < count; }),
         "a triangle refers to a position that does not exist");
}

void CheckWindow(const TargetWindow& window, Faults& faults) {
  faults.Require(std::isfinite(window.width_m) && window.width_m > 0.0 &&
                     std::isfinite(window.height_m) && window.height_m > 0.0,
                 fmt::format("a window of {} m x {} m must have positive sides", window.width_m,
                             window.height_m));
}

}  // namespace

std::array<Eigen::Vector3d, 4> TargetWindow::Corners_W() const {
  const double x = 0.5 * width_m;
  const double y = 0.5 * height_m;
  return {X_WO * Eigen::Vector3d(-x, y, 0.0), X_WO * Eigen::Vector3d(x, y, 0.0),
          X_WO * Eigen::Vector3d(x, -y, 0.0), X_WO * Eigen::Vector3d(-x, -y, 0.0)};
}

void Validate(const Scene& scene) {
  Faults faults("scene");
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    CheckMaterial(scene.materials[i], i, scene.textures.size(), faults);
  }
  for (size_t i = 0; i < scene.textures.size(); ++i) CheckTexture(scene.textures[i], i, faults);
  for (size_t i = 0; i < scene.lamps.size(); ++i) CheckLamp(scene.lamps[i], i, faults);
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    CheckMesh(scene.meshes[i], i, scene.materials.size(), faults);
  }
  if (scene.target) CheckWindow(*scene.target, faults);
  for (const TargetWindow& window : scene.other_windows) CheckWindow(window, faults);
  faults.ThrowIfAny();
}

}  // namespace fenestra
