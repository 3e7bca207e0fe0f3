#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/images.h"
#include "scenes/gltf/tinygltf.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

/// Placement of a material's texture on a mesh: the coordinate set and KHR_texture_transform,
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

/// nullopt if the material has no such texture, or if the texture's image cannot be read.
std::optional<TextureUse> ReadTextureUse(const tinygltf::Model& model,
                                         const tinygltf::TextureInfo& info);

/// The textures that a scene needs, decoded.
class TextureShelf {
 public:
  TextureShelf(const Asset& asset, size_t max_pixels) : asset_(asset), budget_(max_pixels) {}

  /// Decodes these textures of the document, in the order of their indices.
  void Load(const std::set<int>& textures);

  /// Index into Textures() of a texture that was loaded.
  uint32_t IndexOf(int texture) const { return indices_.at(texture); }
  /// Mean of each colour over the picture, linear.
  glm::dvec3 MeanLinear(int texture);

  std::vector<Texture> Take() { return std::move(textures_); }

 private:
  const Picture& PictureOf(int texture);

  const Asset& asset_;
  PixelBudget budget_;
  std::map<int, Picture> pictures_;  // By image.
  std::map<int, uint32_t> indices_;  // By texture of the document.
  std::vector<Texture> textures_;
};

}  // namespace fenestra::gltf
