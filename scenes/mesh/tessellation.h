#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "scenes/mesh/solid_lattice.h"
#include "scenes/scene.h"

namespace fenestra {

/// The scene with all edges at most `longest_edge_m` long, for light that is known at vertices. A
/// longer edge is halved in all its triangles until it is short enough, so that triangles that
/// share an edge still share it. Texture coordinates, colours and normals are interpolated. Closed
/// meshes stay as they are, since their vertices were chosen where the solids were made. Windows
/// stay the same.
///
/// Throws InputError unless the length is positive.
Scene Tessellated(const Scene& scene, double longest_edge_m);

/// A length that splits the scene's surface into about this many triangles [m]; infinite if there
/// are that many already.
double EdgeForTriangles(const Scene& scene, size_t triangles);

/// Splits edges until none is longer than what `longest_edge_m` allows at its middle. An edge is
/// split in all its triangles, of all solids, so a surface without cracks and T-junctions stays
/// one, and fine parts do not make the whole wall fine.
///
/// Source: M.-C. Rivara, "Algorithms for refining triangular grids suitable for adaptive and
/// multigrid techniques", Int. J. Numer. Methods Eng. 20 (1984): triangles are bisected at their
/// longest edge first, which keeps their angles from degenerating.
void BisectLongEdges(SolidSurface& surface,
                     const std::function<double(const glm::vec3&)>& longest_edge_m);

}  // namespace fenestra
