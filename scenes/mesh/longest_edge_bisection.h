#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "scenes/mesh/solid_lattice.h"

namespace fenestra {

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
