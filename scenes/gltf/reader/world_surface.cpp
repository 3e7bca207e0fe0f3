#include "scenes/gltf/reader/world_surface.h"

#include <Eigen/LU>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace fenestra::gltf {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

Vector3d ToEigen(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

glm::vec3 ToGlm(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// By the inverse transpose, which is the matrix of cofactors over the determinant: normals stay
// perpendicular, and outward even if mirrored.
glm::vec3 TransformNormal(const Matrix3d& L, const glm::vec3& normal) {
  if (L == Matrix3d::Identity()) return normal;
  Matrix3d cofactors;
  cofactors.col(0) = L.col(1).cross(L.col(2));
  cofactors.col(1) = L.col(2).cross(L.col(0));
  cofactors.col(2) = L.col(0).cross(L.col(1));
  const Vector3d n = cofactors * ToEigen(normal) * (L.determinant() < 0.0 ? -1.0 : 1.0);
  return ToGlm(n.normalized());
}

// Normalises vectors; those that are unit vectors in single precision keep their bits. Returns
// false if one has no direction.
bool Normalise(std::vector<glm::vec3>& normals) {
  constexpr double kUnitTolerance = 1e-6;
  for (glm::vec3& n : normals) {
    const double length = glm::length(glm::dvec3(n));
    if (!(length > 0.0) || !std::isfinite(length)) return false;
    if (std::abs(length - 1.0) > kUnitTolerance) n = glm::dvec3(n) / length;
  }
  return true;
}

template <typename TransformOf>
Mesh Carry(const Surface& surface, const TransformOf& transform_of) {
  Mesh mesh;
  mesh.positions_W.reserve(surface.positions_M.size());
  for (size_t v = 0; v < surface.positions_M.size(); ++v) {
    const Matrix4d& M = transform_of(v);
    const Vector3d p = ToEigen(surface.positions_M[v]);
    mesh.positions_W.push_back(ToGlm(M.topLeftCorner<3, 3>() * p + M.topRightCorner<3, 1>()));
  }
  mesh.normals_W.reserve(surface.normals_M.size());
  for (size_t v = 0; v < surface.normals_M.size(); ++v) {
    mesh.normals_W.push_back(
        TransformNormal(transform_of(v).template topLeftCorner<3, 3>(), surface.normals_M[v]));
  }
  if (!Normalise(mesh.normals_W)) mesh.normals_W.clear();
  mesh.triangles = surface.triangles;
  mesh.texture_coordinates = surface.texture_coordinates;
  mesh.colors = surface.colors;
  return mesh;
}

}  // namespace

Mesh CarryToWorld(const Surface& surface, const Matrix4d& M_WM) {
  Mesh mesh = Carry(surface, [&M_WM](size_t) -> const Matrix4d& { return M_WM; });
  if (M_WM.topLeftCorner<3, 3>().determinant() < 0.0) {
    // Mirrored, the triangles would wind inside out.
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  }
  return mesh;
}

Mesh CarryToWorld(const Surface& surface, const std::vector<Matrix4d>& M_WM_of_vertex) {
  return Carry(surface, [&](size_t v) -> const Matrix4d& { return M_WM_of_vertex[v]; });
}

}  // namespace fenestra::gltf
