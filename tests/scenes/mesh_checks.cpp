#include "tests/scenes/mesh_checks.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fenestra {
namespace {

Corner At(const Mesh& mesh, uint32_t index) {
  const glm::vec3& p = mesh.positions_W[index];
  return {p.x, p.y, p.z};
}

}  // namespace

std::map<std::pair<Corner, Corner>, int> EdgeBalance(std::span<const Mesh> meshes) {
  std::map<std::pair<Corner, Corner>, int> balance;
  for (const Mesh& mesh : meshes) {
    for (const glm::uvec3& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        const Corner a = At(mesh, t[k]);
        const Corner b = At(mesh, t[(k + 1) % 3]);
        if (a < b) {
          ++balance[{a, b}];
        } else {
          --balance[{b, a}];
        }
      }
    }
  }
  return balance;
}

bool IsWatertight(const Mesh& mesh) {
  const auto balance = EdgeBalance({&mesh, 1});
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

double EnclosedVolume(const Mesh& mesh) {
  double six_volumes = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    six_volumes +=
        glm::dot(glm::dvec3(mesh.positions_W[t.x]),
                 glm::cross(glm::dvec3(mesh.positions_W[t.y]), glm::dvec3(mesh.positions_W[t.z])));
  }
  return six_volumes / 6.0;
}

double AreaInPlane(const Mesh& mesh, double z) {
  double area = 0.0;
  const auto plane = static_cast<double>(static_cast<float>(z));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions_W[t.x];
    const glm::dvec3 b = mesh.positions_W[t.y];
    const glm::dvec3 c = mesh.positions_W[t.z];
    if (a.z == plane && b.z == plane && c.z == plane) {
      area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
  }
  return area;
}

const Mesh* Find(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.meshes, name, &Mesh::name);
  return found == scene.meshes.end() ? nullptr : &*found;
}

}  // namespace fenestra
