#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "scenes/scene.h"

namespace fenestra {

/// A texture in linear light at all resolutions, each half as wide and high as the one before.
/// Source: L. Williams, "Pyramidal parametrics", 1983.
class MipMap {
 public:
  /// The texture must be valid.
  explicit MipMap(const Texture& texture);

  /// Red, green, blue and alpha, each in [0, 1], averaged over about `width_texels` texels around
  /// the coordinates: linear within a level and between levels.
  glm::vec4 Sample(glm::vec2 coordinates, float width_texels) const;

  /// Alpha of the nearest texel of the full resolution.
  float AlphaAt(glm::vec2 coordinates) const;

  glm::vec2 size_px() const {
    return {static_cast<float>(levels_[0].width), static_cast<float>(levels_[0].height)};
  }

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<glm::u16vec4> texels;  // Linear, 65535 for 1.
    glm::vec4 At(int x, int y) const;
    const glm::u16vec4* Row(int y) const {
      return texels.data() + static_cast<size_t>(y) * static_cast<size_t>(width);
    }
  };

  static Level Halved(const Level& level);
  glm::vec4 SampleLevel(const Level& level, glm::vec2 coordinates) const;

  Texture::Wrap wrap_u_;
  Texture::Wrap wrap_v_;
  bool interpolated_;
  std::vector<Level> levels_;
};

}  // namespace fenestra
