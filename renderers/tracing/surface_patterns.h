#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "renderers/tracing/mip_map.h"
#include "renderers/tracing/triangle_soup.h"

namespace fenestra {

/// Factors by which textures and vertex colours multiply reflectance and emission of a soup's
/// triangles.
class SurfacePatterns {
 public:
  SurfacePatterns(const Scene& scene, const TriangleSoup& soup);

  /// Whether any triangle has a pattern at all.
  bool any() const { return any_; }
  bool has_pattern(uint32_t triangle) const { return of_[triangle].has_pattern; }

  /// Factors (red, green, blue) at barycentric (u, v), averaged over about `width_m` on the
  /// surface.
  glm::vec3 At(uint32_t triangle, float u, float v, float width_m) const;

  /// Factors averaged over about the whole triangle.
  glm::vec3 Mean(uint32_t triangle) const;

  /// Whether the surface has a hole there.
  bool IsHole(uint32_t triangle, float u, float v) const;

 private:
  struct Pattern {
    bool has_pattern = false;
    bool has_colors = false;
    int texture = -1;  // Index into mip_maps_.
    float texels_per_m = 0.0f;
    float alpha_cutoff = 0.0f;
    float size_m = 0.0f;
  };

  glm::vec2 CoordinatesAt(uint32_t triangle, float u, float v) const;

  const TriangleSoup& soup_;
  std::vector<MipMap> mip_maps_;
  std::vector<Pattern> of_;
  bool any_ = false;
};

}  // namespace fenestra
