#include "scenes/gltf/meshes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/input_error.h"
#include "scenes/gltf/skinning.h"
#include "scenes/gltf/surfaces.h"
#include "scenes/gltf/values.h"

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

const tinygltf::Mesh* MeshOf(const Asset& asset, const PlacedNode& placed) {
  const int mesh = asset.model.nodes[placed.node].mesh;
  return placed.is_visible && mesh >= 0 ? &asset.model.meshes[static_cast<size_t>(mesh)] : nullptr;
}

void CheckTriangleCount(const Asset& asset, const std::vector<PlacedNode>& nodes, size_t most) {
  size_t triangles = 0;
  size_t vertices = 0;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Mesh* mesh = MeshOf(asset, placed);
    if (mesh == nullptr) continue;
    for (const tinygltf::Primitive& primitive : mesh->primitives) {
      if (!IsSurface(primitive)) continue;
      triangles += ClaimedTriangles(asset, primitive);
      vertices +=
          asset.model.accessors[static_cast<size_t>(primitive.attributes.at("POSITION"))].count;
      if (triangles > most || vertices > 3 * most) {
        throw InputError(
            asset.file, fmt::format("/nodes/{}: with its mesh the scene has more than {} triangles",
                                    placed.node, most));
      }
    }
  }
}

// Unit vectors. Those that are unit vectors in single precision keep their bits; without a
// direction there is nothing to shade by.
bool Normalise(std::vector<glm::vec3>& normals) {
  constexpr double kUnitTolerance = 1e-6;
  for (glm::vec3& n : normals) {
    const double length = glm::length(glm::dvec3(n));
    if (!(length > 0.0) || !std::isfinite(length)) return false;
    if (std::abs(length - 1.0) > kUnitTolerance) n = glm::dvec3(n) / length;
  }
  return true;
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

class MeshPlacer {
 public:
  MeshPlacer(const Asset& asset, const std::vector<PlacedNode>& nodes,
             const std::vector<ReadMaterial>& materials, Notes& notes)
      : asset_(asset), materials_(materials), notes_(notes), by_node_(asset.model.nodes.size()) {
    for (const PlacedNode& placed : nodes) by_node_[placed.node] = &placed;
  }

  void Place(const PlacedNode& placed, std::vector<Mesh>& meshes);

 private:
  std::optional<Mesh> PlacePrimitive(const PlacedNode& placed, const tinygltf::Mesh& mesh,
                                     const tinygltf::Primitive& primitive, const std::string& name);
  void Transform(const PlacedNode& placed, const Surface& surface, Mesh& mesh) const;

  const Asset& asset_;
  const std::vector<ReadMaterial>& materials_;
  Notes& notes_;
  std::vector<const PlacedNode*> by_node_;  // nullptr where a node is not in the scene.
};

void MeshPlacer::Place(const PlacedNode& placed, std::vector<Mesh>& meshes) {
  const tinygltf::Mesh* source = MeshOf(asset_, placed);
  if (source == nullptr) return;
  const std::string& node_name = asset_.model.nodes[placed.node].name;
  const std::string& name = node_name.empty() ? source->name : node_name;
  for (size_t i = 0; i < source->primitives.size(); ++i) {
    const bool is_only_one = source->primitives.size() == 1;
    std::optional<Mesh> mesh = PlacePrimitive(placed, *source, source->primitives[i],
                                              is_only_one ? name : fmt::format("{}.{}", name, i));
    if (mesh) meshes.push_back(std::move(*mesh));
  }
}

std::optional<Mesh> MeshPlacer::PlacePrimitive(const PlacedNode& placed,
                                               const tinygltf::Mesh& source,
                                               const tinygltf::Primitive& primitive,
                                               const std::string& name) {
  const tinygltf::Node& node = asset_.model.nodes[placed.node];
  const std::string thing = Named("mesh", name, static_cast<size_t>(node.mesh));
  if (!IsSurface(primitive)) {
    notes_.Add("points, lines and primitives without positions are left out", thing);
    return std::nullopt;
  }
  Mesh mesh;
  mesh.name = name;
  std::optional<TextureUse> texture;
  mesh.material = static_cast<uint32_t>(materials_.size());
  if (primitive.material >= 0) {
    mesh.material = static_cast<uint32_t>(primitive.material);
    const ReadMaterial& material = materials_[mesh.material];
    if (material.is_invisible) return std::nullopt;
    texture = material.texture;
  }
  Surface surface =
      ReadSurface(asset_, primitive, texture, node.weights.empty() ? source.weights : node.weights,
                  thing, notes_);
  if (surface.triangles.empty()) return std::nullopt;
  Transform(placed, surface, mesh);
  if (!Normalise(mesh.normals_W)) {
    notes_.Add("some of its normals have no direction, so it is rendered without", thing);
    mesh.normals_W.clear();
  }
  mesh.triangles = std::move(surface.triangles);
  if (node.skin < 0 && placed.M_WN.topLeftCorner<3, 3>().determinant() < 0.0) {
    for (glm::uvec3& t : mesh.triangles)
      std::swap(t.y, t.z);  // Mirrored, it would wind inside out.
  }
  mesh.texture_coordinates = std::move(surface.texture_coordinates);
  mesh.colors = std::move(surface.colors);
  const tinygltf::Value* closed = Find(source.extras, {"fenestra", "closed"});
  mesh.closed = closed != nullptr && closed->Get<bool>();
  return mesh;
}

void MeshPlacer::Transform(const PlacedNode& placed, const Surface& surface, Mesh& mesh) const {
  const int skin = asset_.model.nodes[placed.node].skin;
  const bool is_skinned = skin >= 0 && !surface.joint_sets.empty();
  std::vector<Matrix4d> each;
  if (is_skinned) each = SkinTransforms(asset_, static_cast<size_t>(skin), surface, by_node_);
  const auto transform_of = [&](size_t vertex) -> const Matrix4d& {
    return is_skinned ? each[vertex] : placed.M_WN;
  };
  mesh.positions_W.reserve(surface.positions_M.size());
  for (size_t v = 0; v < surface.positions_M.size(); ++v) {
    const Matrix4d& M = transform_of(v);
    const Vector3d p = ToEigen(surface.positions_M[v]);
    mesh.positions_W.push_back(ToGlm(M.topLeftCorner<3, 3>() * p + M.topRightCorner<3, 1>()));
  }
  mesh.normals_W.reserve(surface.normals_M.size());
  for (size_t v = 0; v < surface.normals_M.size(); ++v) {
    mesh.normals_W.push_back(
        TransformNormal(transform_of(v).topLeftCorner<3, 3>(), surface.normals_M[v]));
  }
}

}  // namespace

PlacedMeshes PlaceMeshes(const Asset& asset, const std::vector<PlacedNode>& nodes,
                         const std::vector<ReadMaterial>& materials, size_t max_triangles,
                         Notes& notes) {
  CheckTriangleCount(asset, nodes, max_triangles);
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
