#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <set>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/images.h"
#include "scenes/texture.h"

namespace fenestra::gltf {

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
