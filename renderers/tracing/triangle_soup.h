#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/scene.h"

namespace fenestra {

/// All triangles of a scene that are of one kind. Triangles without area are left out, since no
/// ray can hit them. Triangles whose texture has holes come last; otherwise they are in the order
/// of the meshes.
struct TriangleSoup {
  std::vector<glm::vec3> positions_W;
  std::vector<glm::uvec3> triangles;  ///< Indices into positions_W.
  std::vector<uint32_t> mesh_of;      ///< Index of each triangle's mesh in the scene.
  std::vector<glm::vec3>
      normals_W;                ///< Unit normal of each triangle, right-handed with its corners.
  std::vector<bool> is_closed;  ///< Mesh::closed of each triangle.
  size_t solid_count = 0;       ///< Number of triangles before the first one with holes.

  /// Attributes of each position. A mesh without texture coordinates has zeros, one without colours
  /// ones, and one without normals zero vectors.
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

/// Numbers the surfaces to which the triangles belong. A visible edge lies between surfaces with
/// different numbers. Triangles of one mesh are of one surface if their planes agree to about
/// 1e-4 in the normal and 0.1 mm in the distance, or if they are smooth and share an edge with the
/// same normals at its ends.
std::vector<uint32_t> NumberSurfaces(const TriangleSoup& soup);

/// Whether each triangle bounds a solid body on its back: it belongs to a closed mesh (see
/// Mesh::closed), or its edges lead to triangles that together have no border and enclose a
/// positive volume. Positions are the same if they are equal to the bit, in all meshes: the faces
/// of a body may have materials of their own. So a ray that meets the back of such a triangle began
/// inside the body, however many bodies touch or penetrate each other.
///
/// A surface has no border if each of its edges is passed as often in one direction as in the
/// other: its winding number is then the same integer everywhere between its sheets.
std::vector<bool> BoundBodies(const TriangleSoup& soup);

}  // namespace fenestra
