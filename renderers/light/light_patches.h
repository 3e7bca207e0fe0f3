#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderers/tracing/triangle_soup.h"

namespace fenestra {

/// A part of a surface over which light is known as a function of two coordinates:
///
///     p_W = origin_W + s s_axis_W + t t_axis_W.
///
/// Coplanar triangles of one surface that touch each other make up one patch, in whose bounding
/// rectangle (s, t) is in [0, 1]². A triangle with normals of its own is a patch by itself, and
/// (s, t) are its barycentric (u, v).
struct LightPatch {
  glm::vec3 origin_W{0.0f};
  glm::vec3 s_axis_W{0.0f};
  glm::vec3 t_axis_W{0.0f};
  glm::vec3 n_W{0.0f};
  float width_m = 0.0f;   ///< Length of s_axis_W.
  float height_m = 0.0f;  ///< Length of t_axis_W.
  std::vector<uint32_t> triangles;
  uint32_t surface = 0;  ///< See NumberSurfaces.
  bool is_smooth = false;
  bool has_back = true;  ///< Whether anything is seen of its back: see Mesh::closed.

  glm::vec3 At(const glm::vec2& st) const { return origin_W + st.x * s_axis_W + st.y * t_axis_W; }
};

/// A triangle of the soup in the coordinates of its patch.
using PatchTriangle = std::array<glm::vec2, 3>;

/// Whether a point lies in a triangle, or on its outline.
bool Contains(const PatchTriangle& triangle, const glm::vec2& point);

/// Whether two triangles have a point in common, but for rounding.
bool Overlap(const PatchTriangle& a, const PatchTriangle& b);

/// The patches of all triangles of a soup. A side of a patch is a face: the front of patch i is
/// face 2 i, its back face 2 i + 1.
class LightPatches {
 public:
  LightPatches(const TriangleSoup& soup, const std::vector<uint32_t>& surfaces);

  const std::vector<LightPatch>& patches() const { return patches_; }
  size_t face_count() const { return 2 * patches_.size(); }
  const LightPatch& PatchOfFace(size_t face) const { return patches_[face / 2]; }
  static bool IsFront(size_t face) { return face % 2 == 0; }

  uint32_t PatchOf(uint32_t triangle) const { return patch_of_[triangle]; }
  /// The face to which a side of a triangle belongs: see SideIndex.
  uint32_t FaceOf(uint32_t side) const { return 2 * patch_of_[side / 2] + side % 2; }

  const PatchTriangle& InPatch(uint32_t triangle) const { return in_patch_[triangle]; }
  glm::vec2 At(uint32_t triangle, float u, float v) const {
    const PatchTriangle& t = in_patch_[triangle];
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
  }

 private:
  void AddRectangle(const TriangleSoup& soup, std::vector<uint32_t> triangles, uint32_t surface);
  void AddTriangle(const TriangleSoup& soup, uint32_t triangle, uint32_t surface);

  std::vector<LightPatch> patches_;
  std::vector<uint32_t> patch_of_;
  std::vector<PatchTriangle> in_patch_;
};

}  // namespace fenestra
