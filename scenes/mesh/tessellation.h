#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>

#include "scenes/mesh/solid_lattice.h"
#include "scenes/scene.h"

namespace fenestra {

/// The scene with its surfaces cut into at least so many triangles, and at most twice as many,
/// for light that is known at vertices. The longest edge is halved first, in all its triangles, so
/// that triangles that share an edge still share it. Texture coordinates, colours and normals are
/// interpolated. Closed meshes do not count and stay as they are, since their vertices were chosen
/// where the solids were made. Windows stay the same.
///
/// Each step makes one more triangle, so this ends for any coordinates. Where they are so large
/// that no float lies between the ends of an edge, the edge stays, and there are fewer triangles.
Scene Tessellated(Scene scene, size_t triangles);

/// Splits edges until none is longer than what `longest_edge_m` allows at its middle. An edge is
/// split in all its triangles, of all solids, so a surface without cracks and T-junctions stays
/// one, and fine parts do not make the whole wall fine. An edge without a float between its ends
/// stays as it is.
///
/// Source: M.-C. Rivara, "Algorithms for refining triangular grids suitable for adaptive and
/// multigrid techniques", Int. J. Numer. Methods Eng. 20 (1984): triangles are bisected at their
/// longest edge first, which keeps their angles from degenerating.
void BisectLongEdges(SolidSurface& surface,
                     const std::function<double(const glm::vec3&)>& longest_edge_m);

}  // namespace fenestra
