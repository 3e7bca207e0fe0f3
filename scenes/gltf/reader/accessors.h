#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "scenes/gltf/reader/asset.h"

namespace fenestra::gltf {

/// Elements of accessors may be packed, interleaved, sparse, or undefined, which means zeros.
/// Normalised integers become [0, 1] or [-1, 1] by section 3.11 of the specification; other
/// integers keep their value.

/// All components of all elements, in order. Throws InputError for a component that is not a
/// finite number, for a sparse accessor whose indices are out of order, and where the buffer has no
/// data.
std::vector<float> ReadFloats(const Asset& asset, int accessor);

/// The elements of an accessor of vectors.
std::vector<glm::vec2> ReadVec2(const Asset& asset, int accessor);
std::vector<glm::vec3> ReadVec3(const Asset& asset, int accessor);
/// A VEC3 gets w = 1, as a colour without alpha.
std::vector<glm::vec4> ReadVec4(const Asset& asset, int accessor);

/// The values of an accessor of unsigned integers.
std::vector<uint32_t> ReadUnsigned(const Asset& asset, int accessor);

/// Whether a primitive's mode (TINYGLTF_MODE_...) makes triangles, and how many triangles it makes
/// of so many vertices.
bool HasTriangles(int mode);
size_t TriangleCount(int mode, size_t vertices);

/// The triangles of a list, strip or fan of vertices, with the winding of section 3.7.2.1 of the
/// specification. Those that use a vertex twice, as strips do to join their parts, are left out.
std::vector<glm::uvec3> Triangles(int mode, const std::vector<uint32_t>& vertices);

}  // namespace fenestra::gltf
