#include "scenes/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input_error.h"

namespace fenestra {
namespace {

bool InUnitInterval(float x) {
  return x >= 0.0f && x <= 1.0f;  // False for NaN.
}

void CheckMaterial(const Material& material, size_t index, std::vector<InputFault>& faults) {
  const auto demand = [&](bool holds, const char* message) {
    if (holds) return;
    faults.push_back(
        {"scene", 0, 0, fmt::format("material {} '{}': {}", index, material.name, message)});
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
}

void CheckMesh(const Mesh& mesh, size_t index, size_t material_count,
               std::vector<InputFault>& faults) {
  const auto demand = [&](bool holds, const char* message) {
    if (holds) return;
    faults.push_back({"scene", 0, 0, fmt::format("mesh {} '{}': {}", index, mesh.name, message)});
  };
  demand(mesh.material < material_count, "its material does not exist");
  demand(std::ranges::all_of(mesh.positions_W,
                             [](const glm::vec3& p) {
                               return std::isfinite(p.x) && std::isfinite(p.y) &&
                                      std::isfinite(p.z);
                             }),
         "positions must be finite");
  const size_t count = mesh.positions_W.size();
  demand(std::ranges::all_of(
             mesh.triangles,
             [count](const glm::uvec3& t) { return t.x < count && t.y < count && t.z < count; }),
         "a triangle refers to a position that does not exist");
}

void CheckWindow(const TargetWindow& window, std::vector<InputFault>& faults) {
  if (std::isfinite(window.width_m) && window.width_m > 0.0 && std::isfinite(window.height_m) &&
      window.height_m > 0.0) {
    return;
  }
  faults.push_back({"scene", 0, 0,
                    fmt::format("a window of {} m x {} m must have positive sides", window.width_m,
                                window.height_m)});
}

}  // namespace

std::array<Eigen::Vector3d, 4> TargetWindow::Corners_W() const {
  const double x = 0.5 * width_m;
  const double y = 0.5 * height_m;
  return {X_WO * Eigen::Vector3d(-x, y, 0.0), X_WO * Eigen::Vector3d(x, y, 0.0),
          X_WO * Eigen::Vector3d(x, -y, 0.0), X_WO * Eigen::Vector3d(-x, -y, 0.0)};
}

void Validate(const Scene& scene) {
  std::vector<InputFault> faults;
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    CheckMaterial(scene.materials[i], i, faults);
  }
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    CheckMesh(scene.meshes[i], i, scene.materials.size(), faults);
  }
  if (scene.target) CheckWindow(*scene.target, faults);
  for (const TargetWindow& window : scene.other_windows) CheckWindow(window, faults);
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace fenestra
