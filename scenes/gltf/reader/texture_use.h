#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// How a material lays a texture on a mesh: which coordinates, and KHR_texture_transform,
///
///     u' = o_u + s_u u cos ρ + s_v v sin ρ
///     v' = o_v − s_u u sin ρ + s_v v cos ρ
///
/// which turns the coordinates counter-clockwise as one sees the image, whose v points down.
struct TextureUse {
  int texture = 0;         ///< Index into the document's textures.
  int coordinate_set = 0;  ///< n of TEXCOORD_n.
  glm::dvec2 offset{0.0};
  glm::dvec2 scale{1.0};
  double rotation_rad = 0.0;

  glm::vec2 Apply(const glm::vec2& uv) const;
  bool operator==(const TextureUse&) const = default;
};

/// nullopt where the material has no such texture, or one without an image that can be read.
std::optional<TextureUse> ReadTextureUse(const tinygltf::Model& model,
                                         const tinygltf::TextureInfo& info);

}  // namespace fenestra::gltf
