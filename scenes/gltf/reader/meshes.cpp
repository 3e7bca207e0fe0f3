#include "scenes/gltf/reader/meshes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "scenes/gltf/tinygltf.h"

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

using Eigen::Matrix4d;

const tinygltf::Mesh* MeshOf(const Asset& asset, const PlacedNode& placed) {
  const int mesh = asset.model.nodes[placed.node].mesh;
  return placed.is_visible && mesh >= 0 ? &asset.model.meshes[static_cast<size_t>(mesh)] : nullptr;
}

class MeshPlacer {
 public:
  MeshPlacer(const Asset& asset, const std::vector<PlacedNode>& nodes,
             const std::vector<ReadMaterial>& materials, Notes& notes)
      : asset_(asset), materials_(materials), notes_(notes), by_node_(asset.model.nodes.size()) {
    for (const PlacedNode& placed : nodes) by_node_[placed.node] = &placed;
  }

  void Place(const PlacedNode& placed, std::vector<Mesh>& meshes);

 private:
  /// A primitive of a mesh, ready to be placed.
  struct Part {
    std::string suffix;  ///< Of the mesh's name.
    uint32_t material = 0;
    Surface surface;
  };

  std::vector<Part> ReadParts(const tinygltf::Node& node, const std::string& name);
  Mesh PlacePart(const PlacedNode& placed, const Matrix4d& M_NI, const Part& part);

  const Asset& asset_;
  const std::vector<ReadMaterial>& materials_;
  Notes& notes_;
  std::vector<const PlacedNode*> by_node_;  // nullptr where a node is not in the scene.
};

void MeshPlacer::Place(const PlacedNode& placed, std::vector<Mesh>& meshes) {
  const tinygltf::Mesh* source = MeshOf(asset_, placed);
  if (source == nullptr) return;
  const tinygltf::Node& node = asset_.model.nodes[placed.node];
  const std::string& name = node.name.empty() ? source->name : node.name;
  const std::vector<Part> parts = ReadParts(node, name);
  const tinygltf::Value* closed = Find(source->extras, {"fenestra", "closed"});
  const std::vector<Matrix4d> instances = InstanceTransforms(asset_, node);
  for (size_t i = 0; i < instances.size(); ++i) {
    const std::string suffix = instances.size() == 1 ? "" : fmt::format("[{}]", i);
    for (const Part& part : parts) {
      Mesh& mesh = meshes.emplace_back(PlacePart(placed, instances[i], part));
      mesh.name = name + suffix + part.suffix;
      mesh.material = part.material;
      mesh.closed = closed != nullptr && closed->Get<bool>();
    }
  }
}

std::vector<MeshPlacer::Part> MeshPlacer::ReadParts(const tinygltf::Node& node,
                                                    const std::string& name) {
  const tinygltf::Mesh& mesh = asset_.model.meshes[static_cast<size_t>(node.mesh)];
  const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
  const std::string thing = Named("mesh", name, static_cast<size_t>(node.mesh));
  std::vector<Part> parts;
  for (size_t i = 0; i < mesh.primitives.size(); ++i) {
    const tinygltf::Primitive& primitive = mesh.primitives[i];
    if (!IsSurface(primitive)) {
      notes_.Add("points, lines and primitives without positions are left out", thing);
      continue;
    }
    Part part{.suffix = mesh.primitives.size() == 1 ? "" : fmt::format(".{}", i),
              .material = static_cast<uint32_t>(materials_.size()),
              .surface = {}};
    std::optional<TextureUse> texture;
    if (primitive.material >= 0) {
      part.material = static_cast<uint32_t>(primitive.material);
      if (materials_[part.material].is_invisible) continue;
      texture = materials_[part.material].texture;
    }
    part.surface = ReadSurface(asset_, primitive, texture, weights, thing, notes_);
    if (!part.surface.triangles.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

Mesh MeshPlacer::PlacePart(const PlacedNode& placed, const Matrix4d& M_NI, const Part& part) {
  const tinygltf::Node& node = asset_.model.nodes[placed.node];
  const bool is_skinned = node.skin >= 0 && !part.surface.joint_sets.empty();
  Mesh mesh =
      is_skinned ? CarryToWorld(part.surface, SkinTransforms(asset_, static_cast<size_t>(node.skin),
                                                             part.surface, by_node_))
                 : CarryToWorld(part.surface, placed.M_WN * M_NI);
  if (mesh.normals_W.empty() && !part.surface.normals_M.empty()) {
    notes_.Add("some of its normals have no direction, so it is rendered without",
               Named("mesh", node.name, static_cast<size_t>(node.mesh)));
  }
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

PlacedMeshes PlaceMeshes(const Asset& asset, const std::vector<PlacedNode>& nodes,
                         const std::vector<ReadMaterial>& materials, Notes& notes) {
  MeshPlacer placer(asset, nodes, materials, notes);
  PlacedMeshes result;
  for (const PlacedNode& placed : nodes) {
    result.first_mesh.push_back(result.meshes.size());
    placer.Place(placed, result.meshes);
  }
  result.first_mesh.push_back(result.meshes.size());
  return result;
}

}  // namespace fenestra::gltf
