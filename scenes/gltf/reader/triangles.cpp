#include "scenes/gltf/reader/triangles.h"

#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

bool HasTriangles(int mode) {
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

size_t TriangleCount(int mode, size_t vertices) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return vertices / 3;
  return vertices < 3 ? 0 : vertices - 2;
}

std::vector<glm::uvec3> Triangles(int mode, const std::vector<uint32_t>& vertices) {
  const std::vector<uint32_t>& v = vertices;
  std::vector<glm::uvec3> triangles;
  const size_t count = TriangleCount(mode, v.size());
  triangles.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    glm::uvec3 t;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      t = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      t = {v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]};
    } else {
      t = {v[i + 1], v[i + 2], v[0]};
    }
    if (t.x != t.y && t.y != t.z && t.z != t.x) triangles.push_back(t);
  }
  return triangles;
}

}  // namespace fenestra::gltf
