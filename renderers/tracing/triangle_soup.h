#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/scene.h"

namespace fenestra {

/// All triangles of a scene that are of one kind. Triangles without area are left out: no ray can
/// hit them. Those whose texture has holes come last, otherwise they are in the order of the
/// meshes.
struct TriangleSoup {
  std::vector<glm::vec3> positions_W;
  std::vector<glm::uvec3> triangles;  ///< Indices into positions_W.
  std::vector<uint32_t> mesh_of;      ///< Of each triangle, in the scene.
  std::vector<glm::vec3> normals_W;   ///< Of each triangle: unit, right-handed with its corners.
  std::vector<bool> is_closed;        ///< Of each triangle: see Mesh::closed.
  size_t solid_count = 0;             ///< Triangles before the first one with holes.

  /// Of each position. A mesh without texture coordinates has zeros, one without colours ones, and
  /// one without normals zero vectors.
  std::vector<glm::vec2> texture_coordinates;
  std::vector<glm::vec3> colors;
  std::vector<glm::vec3> vertex_normals_W;

  size_t size() const { return triangles.size(); }
  bool is_smooth(size_t triangle) const {
    return vertex_normals_W[triangles[triangle].x] != glm::vec3(0.0f);
  }
};

/// Index of a side of a triangle: the front is the one its normal points to. After the last
/// triangle follow the sky and the ground, as if they were the two sides of one more triangle.
constexpr size_t SideIndex(size_t triangle, bool front) {
  return 2 * triangle + (front ? 0 : 1);
}

TriangleSoup MakeTriangleSoup(const Scene& scene, Material::Kind kind);

/// Numbers the surfaces that the triangles are part of. An edge that is seen lies between surfaces
/// of different numbers. Triangles of one mesh are of one surface if their planes agree to about
/// 1e-4 in the normal and 0.1 mm in the distance, or if they are smooth and share an edge with the
/// same normals at its ends.
std::vector<uint32_t> NumberSurfaces(const TriangleSoup& soup);

}  // namespace fenestra
