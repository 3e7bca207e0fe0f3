#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace fenestra::gltf {

/// Whether a primitive's mode (TINYGLTF_MODE_...) makes triangles, and how many of `vertices`.
bool HasTriangles(int mode);
size_t TriangleCount(int mode, size_t vertices);

/// The triangles of a list, strip or fan of vertices, with the winding of section 3.7.2.1 of the
/// specification. Those that use a vertex twice, as strips do to join their parts, are left out.
std::vector<glm::uvec3> Triangles(int mode, const std::vector<uint32_t>& vertices);

}  // namespace fenestra::gltf
