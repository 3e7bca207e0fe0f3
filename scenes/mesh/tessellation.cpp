#include "scenes/mesh/tessellation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

class MeshSplitter {
 public:
  MeshSplitter(const Mesh& mesh, double longest_edge_m)
      : longest_sq_(longest_edge_m * longest_edge_m), mesh_(mesh) {
    mesh_.triangles.clear();
    for (const glm::uvec3& triangle : mesh.triangles) Split(triangle);
  }

  Mesh Take() { return std::move(mesh_); }

 private:
  double LengthSquared(uint32_t a, uint32_t b) const {
    const glm::dvec3 edge = glm::dvec3(mesh_.positions_W[a]) - glm::dvec3(mesh_.positions_W[b]);
    return glm::dot(edge, edge);
  }

  void Split(const glm::uvec3& triangle) {
    std::vector<glm::uvec3> open = {triangle};
    while (!open.empty()) {
      const glm::uvec3 t = open.back();
      open.pop_back();
      int longest = 0;
      for (int k = 1; k < 3; ++k) {
        if (LengthSquared(t[k], t[(k + 1) % 3]) > LengthSquared(t[longest], t[(longest + 1) % 3])) {
          longest = k;
        }
      }
      const uint32_t a = t[longest];
      const uint32_t b = t[(longest + 1) % 3];
      const uint32_t c = t[(longest + 2) % 3];
      if (LengthSquared(a, b) <= longest_sq_) {
        mesh_.triangles.push_back(t);
        continue;
      }
      const uint32_t m = Middle(a, b);
      open.emplace_back(m, b, c);
      open.emplace_back(a, m, c);
    }
  }

  uint32_t Middle(uint32_t a, uint32_t b) {
    const auto [entry, is_new] =
        middles_.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh_.positions_W.size()));
    if (is_new) {
      AppendMean(mesh_.positions_W, a, b);
      AppendMean(mesh_.texture_coordinates, a, b);
      AppendMean(mesh_.colors, a, b);
      AppendMean(mesh_.normals_W, a, b);
      if (!mesh_.normals_W.empty()) mesh_.normals_W.back() = Unit(mesh_.normals_W.back(), a);
    }
    return entry->second;
  }

  template <typename T>
  static void AppendMean(std::vector<T>& values, uint32_t a, uint32_t b) {
    if (!values.empty()) values.push_back(0.5f * (values[a] + values[b]));
  }

  // The mean of opposite normals has no direction; either will do.
  glm::vec3 Unit(const glm::vec3& mean, uint32_t a) const {
    const float length = glm::length(mean);
    return length > 1e-3f ? mean / length : mesh_.normals_W[a];
  }

  double longest_sq_;
  Mesh mesh_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles_;
};

double Area(const Mesh& mesh) {
  double area_m2 = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions_W[t.x];
    area_m2 += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions_W[t.y]) - a,
                                            glm::dvec3(mesh.positions_W[t.z]) - a));
  }
  return area_m2;
}

}  // namespace

Scene Tessellated(const Scene& scene, double longest_edge_m) {
  if (!(longest_edge_m > 0.0)) {
    throw InputError("tessellation",
                     fmt::format("the longest edge must be positive, not {} m", longest_edge_m));
  }
  Scene result = scene;
  if (std::isinf(longest_edge_m)) return result;
  for (Mesh& mesh : result.meshes) {
    if (!mesh.closed) mesh = MeshSplitter(mesh, longest_edge_m).Take();
  }
  return result;
}

double EdgeForTriangles(const Scene& scene, size_t triangles) {
  double area_m2 = 0.0;
  size_t count = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.closed) continue;
    area_m2 += Area(mesh);
    count += mesh.triangles.size();
  }
  if (count >= triangles) return std::numeric_limits<double>::infinity();
  // Halved right triangles have an area of about a fourth of their longest edge squared.
  const double each_m2 = area_m2 / static_cast<double>(triangles - count);
  return area_m2 > 0.0 ? std::sqrt(4.0 * each_m2) : std::numeric_limits<double>::infinity();
}

}  // namespace fenestra
