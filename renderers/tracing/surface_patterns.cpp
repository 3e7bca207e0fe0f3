#include "renderers/tracing/surface_patterns.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fenestra {
namespace {

constexpr float kThird = 1.0f / 3.0f;

template <typename T>
T Interpolated(const std::vector<T>& values, const glm::uvec3& corners, float u, float v) {
  return (1.0f - u - v) * values[corners.x] + u * values[corners.y] + v * values[corners.z];
}

}  // namespace

SurfacePatterns::SurfacePatterns(const Scene& scene, const TriangleSoup& soup) : soup_(soup) {
  for (const Texture& texture : scene.textures) mip_maps_.emplace_back(texture);
  of_.resize(soup.size());
  for (uint32_t t = 0; t < soup.size(); ++t) {
    const Mesh& mesh = scene.meshes[soup.mesh_of[t]];
    const Material& material = scene.materials[mesh.material];
    const glm::uvec3& corners = soup.triangles[t];
    const glm::dvec3 a = soup.positions_W[corners.x];
    const glm::dvec3 b = soup.positions_W[corners.y];
    const glm::dvec3 c = soup.positions_W[corners.z];
    const double area_m2 = 0.5 * glm::length(glm::cross(b - a, c - a));
    Pattern& pattern = of_[t];
    pattern.size_m = static_cast<float>(std::sqrt(area_m2));
    pattern.has_colors = !mesh.colors.empty();
    pattern.has_pattern = pattern.has_colors;
    if (material.texture && !mesh.texture_coordinates.empty()) {
      pattern.has_pattern = true;
      pattern.texture = static_cast<int>(*material.texture);
      pattern.alpha_cutoff = material.alpha_cutoff;
      const glm::dvec2 size = mip_maps_[*material.texture].size_px();
      const glm::dvec2 origin = soup.texture_coordinates[corners.x];
      const glm::dvec2 e = size * (glm::dvec2(soup.texture_coordinates[corners.y]) - origin);
      const glm::dvec2 f = size * (glm::dvec2(soup.texture_coordinates[corners.z]) - origin);
      const double area_texels = 0.5 * std::abs(e.x * f.y - e.y * f.x);
      pattern.texels_per_m = static_cast<float>(std::sqrt(area_texels / area_m2));
    }
    any_ = any_ || pattern.has_pattern;
  }
}

glm::vec2 SurfacePatterns::CoordinatesAt(uint32_t triangle, float u, float v) const {
  return Interpolated(soup_.texture_coordinates, soup_.triangles[triangle], u, v);
}

glm::vec3 SurfacePatterns::At(uint32_t triangle, float u, float v, float width_m) const {
  const Pattern& pattern = of_[triangle];
  glm::vec3 factors(1.0f);
  if (pattern.has_colors) factors = Interpolated(soup_.colors, soup_.triangles[triangle], u, v);
  if (pattern.texture < 0) return factors;
  const MipMap& map = mip_maps_[static_cast<size_t>(pattern.texture)];
  return factors *
         glm::vec3(map.Sample(CoordinatesAt(triangle, u, v), width_m * pattern.texels_per_m));
}

glm::vec3 SurfacePatterns::Mean(uint32_t triangle) const {
  return At(triangle, kThird, kThird, of_[triangle].size_m);
}

bool SurfacePatterns::IsHole(uint32_t triangle, float u, float v) const {
  const Pattern& pattern = of_[triangle];
  if (pattern.texture < 0 || pattern.alpha_cutoff <= 0.0f) return false;
  return mip_maps_[static_cast<size_t>(pattern.texture)].AlphaAt(CoordinatesAt(triangle, u, v)) <
         pattern.alpha_cutoff;
}

}  // namespace fenestra
