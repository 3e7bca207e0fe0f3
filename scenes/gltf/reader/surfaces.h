#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/textures.h"

namespace fenestra::gltf {

/// Up to four joints that move a vertex, and how much each does.
struct JointWeights {
  std::vector<glm::vec4> joints;  ///< Indices into the skin's joints.
  std::vector<glm::vec4> weights;
};

/// One primitive in its mesh's own axes M, morphed. Per vertex or empty, as in fenestra::Mesh.
struct Surface {
  std::vector<glm::vec3> positions_M;
  std::vector<glm::vec3> normals_M;
  std::vector<glm::vec2> texture_coordinates;  ///< The material's texture transform is applied.
  std::vector<glm::vec3> colors;
  std::vector<glm::uvec3> triangles;
  std::vector<JointWeights> joint_sets;
};

/// The numbers of triangles and of vertices, including those of its morph targets, that a primitive
/// claims to have. No data is read for them.
size_t ClaimedTriangles(const Asset& asset, const tinygltf::Primitive& primitive);
size_t ClaimedVertices(const Asset& asset, const tinygltf::Primitive& primitive);

/// Whether a primitive makes a surface: it has positions and triangles.
bool IsSurface(const tinygltf::Primitive& primitive);

/// Throws InputError for an index beyond the vertices. `weights` are those of the morph targets.
Surface ReadSurface(const Asset& asset, const tinygltf::Primitive& primitive,
                    const std::optional<TextureUse>& texture, const std::vector<double>& weights,
                    const std::string& name, Notes& notes);

}  // namespace fenestra::gltf
