#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "scenes/scene.h"

namespace fenestra {

using Corner = std::array<float, 3>;

/// How often each edge, found by its positions, is walked forward minus backward by the triangles
/// of all meshes. A closed surface walks every edge as often one way as the other; a T-junction
/// would leave a long edge without its opposite.
std::map<std::pair<Corner, Corner>, int> EdgeBalance(std::span<const Mesh> meshes);

/// Whether one closed mesh walks every edge as often one way as the other.
bool IsWatertight(const Mesh& mesh);

/// Positive if the triangles face outwards.
double EnclosedVolume(const Mesh& mesh);

/// Area of those triangles that lie in the plane z = `z`.
double AreaInPlane(const Mesh& mesh, double z);

/// The mesh of that name, or null.
const Mesh* Find(const Scene& scene, const std::string& name);

}  // namespace fenestra
