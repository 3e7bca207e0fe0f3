#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/scene.h"

namespace fenestra {

/// All triangles of a scene whose material is of one kind, in the order of its meshes. Triangles
/// without area are left out: no ray can hit them.
struct TriangleSoup {
  std::vector<glm::vec3> positions_W;
  std::vector<glm::uvec3> triangles;  ///< Indices into positions_W.
  std::vector<uint32_t> mesh_of;      ///< Of each triangle, in the scene.
  std::vector<glm::vec3> normals_W;   ///< Of each triangle: unit, right-handed with its corners.

  std::vector<bool> is_closed;  ///< Of each triangle: see Mesh::closed.

  size_t size() const { return triangles.size(); }
};

TriangleSoup MakeTriangleSoup(const Scene& scene, Material::Kind kind);

/// Numbers the planes that the triangles lie in: two triangles of one mesh whose planes agree to
/// about 1e-4 in the normal and 0.1 mm in the distance have the same number. An edge that is seen
/// lies between surfaces of different numbers.
std::vector<uint32_t> NumberPlanes(const TriangleSoup& soup);

}  // namespace fenestra
