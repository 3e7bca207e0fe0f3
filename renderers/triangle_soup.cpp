#include "renderers/triangle_soup.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace fenestra {

TriangleSoup MakeTriangleSoup(const Scene& scene, Material::Kind kind) {
  TriangleSoup soup;
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    if (scene.materials[mesh.material].kind != kind) continue;
    const auto base = static_cast<uint32_t>(soup.positions_W.size());
    soup.positions_W.insert(soup.positions_W.end(), mesh.positions_W.begin(),
                            mesh.positions_W.end());
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a = mesh.positions_W[t.x];
      const glm::dvec3 cross =
          glm::cross(glm::dvec3(mesh.positions_W[t.y]) - a, glm::dvec3(mesh.positions_W[t.z]) - a);
      const double length = glm::length(cross);
      if (!(length > 0.0)) continue;
      soup.triangles.push_back(t + base);
      soup.mesh_of.push_back(static_cast<uint32_t>(m));
      soup.is_closed.push_back(mesh.closed);
      soup.normals_W.push_back(glm::vec3(cross / length));
    }
  }
  return soup;
}

std::vector<uint32_t> NumberPlanes(const TriangleSoup& soup) {
  constexpr double kNormalStep = 1e-4;
  constexpr double kDistanceStep_m = 1e-4;
  const auto rounded = [](double value, double step) {
    return static_cast<int64_t>(std::llround(value / step));
  };
  std::map<std::array<int64_t, 5>, uint32_t> number_of;
  std::vector<uint32_t> numbers;
  numbers.reserve(soup.size());
  for (size_t i = 0; i < soup.size(); ++i) {
    const glm::dvec3 n = soup.normals_W[i];
    const double distance_m = glm::dot(n, glm::dvec3(soup.positions_W[soup.triangles[i].x]));
    const std::array<int64_t, 5> plane = {soup.mesh_of[i], rounded(n.x, kNormalStep),
                                          rounded(n.y, kNormalStep), rounded(n.z, kNormalStep),
                                          rounded(distance_m, kDistanceStep_m)};
    numbers.push_back(number_of.try_emplace(plane, number_of.size()).first->second);
  }
  return numbers;
}

}  // namespace fenestra
